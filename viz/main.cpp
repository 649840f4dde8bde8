#include "bindings/cli/interrupt.h"
#include "viz/run.h"

int main(int argc, char** argv) {
    clv::cleanUpOnInterrupt();
    return clv::runViz(argc, argv);
}

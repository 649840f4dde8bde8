#include "bindings/cli/command_line.h"
#include "bindings/cli/interrupt.h"

int main(int argc, char** argv) {
    clv::cleanUpOnInterrupt();
    return clv::runCommandLine(argc, argv);
}

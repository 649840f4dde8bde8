#include "bindings/cli/interrupt.h"
#include "bindings/cli/standard_streams.h"
#include "bindings/scene/importer.h"
#include "viz/run.h"

int main(int argc, char** argv) {
    clv::fillStandardDescriptors();
    clv::startImporter();  // before there are threads
    clv::cleanUpOnInterrupt();
    return clv::runViz(argc, argv);
}

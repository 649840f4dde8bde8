#include "viz/picture_file.h"

#include <stdexcept>

#include <fmt/format.h>
#include <vtkErrorCode.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkWindowToImageFilter.h>

#include "bindings/cli/staged_output.h"

namespace clv {

void writePicture(vtkRenderWindow& window, const std::string& file) {
    StagedFile staged(file);
    vtkNew<vtkWindowToImageFilter> pixels;
    pixels->SetInput(&window);
    pixels->SetInputBufferTypeToRGB();
    pixels->ReadFrontBufferOff();
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputConnection(pixels->GetOutputPort());
    writer->SetFileName(staged.path().c_str());
    writer->Write();
    if (writer->GetErrorCode() != vtkErrorCode::NoError) throw std::runtime_error(fmt::format("{}: cannot be written: {}", file, vtkErrorCode::GetStringFromErrorCode(writer->GetErrorCode())));
    staged.commit();
}

}  // namespace clv

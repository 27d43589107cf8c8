// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTransportSVGWriter
 * @brief   writes dots, lines and polygons as SVG 1.1, for browsers, Inkscape and cutting machines
 *
 * Discs are circles, of about 40 bytes each. The page may be a kilometre long.
 *
 * \code{.cpp}
 * vtkNew<vtkTransportSVGWriter> writer;
 * writer->SetInputConnection(sampler->GetOutputPort());
 * writer->SetFileName("dots.svg");
 * writer->SetWidth(200);
 * writer->Write();
 * \endcode
 *
 * @sa vtkTransportVectorWriter
 */
#ifndef vtkTransportSVGWriter_h
#define vtkTransportSVGWriter_h

#include "vtkRectifiedTransportDrawingModule.h" // for the export macro
#include "vtkTransportVectorWriter.h"

VTK_ABI_NAMESPACE_BEGIN
class VTKRECTIFIEDTRANSPORTDRAWING_EXPORT vtkTransportSVGWriter : public vtkTransportVectorWriter
{
public:
  static vtkTransportSVGWriter* New();
  vtkTypeMacro(vtkTransportSVGWriter, vtkTransportVectorWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkTransportSVGWriter() = default;
  ~vtkTransportSVGWriter() override = default;

  std::unique_ptr<RectifiedTransport::Drawing> NewDrawing(
    RectifiedTransport::OutputFile& file) const override;

private:
  vtkTransportSVGWriter(const vtkTransportSVGWriter&) = delete;
  void operator=(const vtkTransportSVGWriter&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTransportPDFWriter
 * @brief   writes dots, lines and polygons as PDF 1.4, with layers 1.5, for print
 *
 * Greys are printed with black ink alone. Discs are one shape that is drawn many times, of about 7
 * bytes each. The page is at most 5080 mm (200 inches) long.
 *
 * \code{.cpp}
 * vtkNew<vtkTransportPDFWriter> writer;
 * writer->SetInputConnection(sampler->GetOutputPort());
 * writer->SetFileName("dots.pdf");
 * writer->SetWidth(200);
 * writer->Write();
 * \endcode
 *
 * @sa vtkTransportVectorWriter
 */
#ifndef vtkTransportPDFWriter_h
#define vtkTransportPDFWriter_h

#include "vtkRectifiedTransportDrawingModule.h" // for the export macro
#include "vtkTransportVectorWriter.h"

VTK_ABI_NAMESPACE_BEGIN
class VTKRECTIFIEDTRANSPORTDRAWING_EXPORT vtkTransportPDFWriter : public vtkTransportVectorWriter
{
public:
  static vtkTransportPDFWriter* New();
  vtkTypeMacro(vtkTransportPDFWriter, vtkTransportVectorWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkTransportPDFWriter() = default;
  ~vtkTransportPDFWriter() override = default;

  std::unique_ptr<RectifiedTransport::Drawing> NewDrawing(
    RectifiedTransport::OutputFile& file) const override;

private:
  vtkTransportPDFWriter(const vtkTransportPDFWriter&) = delete;
  void operator=(const vtkTransportPDFWriter&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTransportVectorWriter
 * @brief   superclass of the writers that draw a vtkPolyData on a page of a physical size
 *
 * The input is a vtkPolyData, or a composite data set of several, which are drawn one on top of the
 * other. The page shows the plane of the two longest axes of the bounds: the first points to the
 * right, the second up. Data in space are seen along the shortest axis and drawn in the order of
 * their cells, not of their depth.
 *
 * Polygons and triangle strips are drawn first, then lines, then vertices as discs. Points without
 * any cells are discs, too. Input array 0, SetInputArrayToProcess(0, 0, 0, association, name), is
 * the ColorArray, of points or cells: three or four unsigned chars are red, green, blue and opacity
 * as they are; any other array is mapped by LookupTable. With colors on points, a polygon has the
 * mean color of its points, and each segment of a line the mean of its two ends. Without this array
 * everything is black, and polygons are outlined instead of filled. Input array 1 is the
 * RadiusArray: one component a point, in units of the data. Input array 2 is the LayerArray, of
 * points or cells: each of its values, at most 100 whole numbers or texts, is a layer with the
 * label "name value", a group of Inkscape in SVG and an optional content group in PDF. A higher
 * value lies on top, and a shape with values on points has that of its first one. Data sets of a
 * composite that lack an array are drawn as without it, below all layers.
 *
 * The whole drawing fits on the page, the discs' radii and half of the LineWidth included, unless
 * PageBounds are set: then these are what the page shows, and the rest is cut off. Points and cells
 * that the ghost array marks as duplicate or hidden are not drawn.
 *
 * The file appears under its name when it is complete: after an error or an abort, an earlier file
 * of this name is unchanged. An input without points is an error.
 *
 * If there are several MPI ranks, all of them must call Write() with their parts of the data. Rank
 * 0 writes them all.
 *
 * Cost: O(n) for n points and cells, and O(n log n) for the radius of n vertices, if it is not
 * given. Memory: 24 bytes a point that is not double, 40 a vertex for its radius, and 8 an edge for
 * the automatic LineWidth.
 *
 * @sa vtkTransportSVGWriter vtkTransportPDFWriter
 */
#ifndef vtkTransportVectorWriter_h
#define vtkTransportVectorWriter_h

#include "vtkCollectiveAlgorithm.h"
#include "vtkRectifiedTransportDrawingModule.h" // for the export macro

namespace RectifiedTransport
{
class Drawing;
class OutputFile;
} // namespace RectifiedTransport

VTK_ABI_NAMESPACE_BEGIN
class vtkScalarsToColors;

class VTKRECTIFIEDTRANSPORTDRAWING_EXPORT vtkTransportVectorWriter : public vtkCollectiveAlgorithm
{
public:
  vtkTypeMacro(vtkTransportVectorWriter, vtkCollectiveAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file to write. Default: none, an error.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /**
   * The width of the page in millimetres, above 0. The height follows from the data. Default 100.
   */
  vtkSetMacro(Width, double);
  vtkGetMacro(Width, double);
  ///@}

  ///@{
  /**
   * The margin that stays empty on all four sides of the page, in millimetres, 0 or more; twice
   * this must be less than Width. Default 0.
   */
  vtkSetMacro(PageMargin, double);
  vtkGetMacro(PageMargin, double);
  ///@}

  ///@{
  /**
   * What the page shows inside of PageMargin, in units of the data: xmin, xmax, ymin, ymax, zmin,
   * zmax, finite and in ascending order, in the plane of the two longest axes. What lies outside is
   * cut off. Pages with the same PageBounds and Width are equal in size and scale. Default 0 0 0
   * 0 0 0: the bounds of what is drawn.
   */
  vtkSetVector6Macro(PageBounds, double);
  vtkGetVector6Macro(PageBounds, double);
  ///@}

  ///@{
  /**
   * The radius of all discs, in units of the data, 0 or more. Default 0: from the spacing, half the
   * distance of nearest neighbours where points are dense, so that discs touch there. Not used with
   * a RadiusArray.
   */
  vtkSetMacro(PointRadius, double);
  vtkGetMacro(PointRadius, double);
  ///@}

  ///@{
  /**
   * The width of lines and of the outlines of polygons, in millimetres, 0 or more. Default 0: a
   * quarter of the median length of edges, from 0.05 to 0.25.
   */
  vtkSetMacro(LineWidth, double);
  vtkGetMacro(LineWidth, double);
  ///@}

  ///@{
  /**
   * Fill the areas within lines that end where they begin, such as countries, with the colors of
   * the lines, which are black then. Lines with the same cell data are one region: what is inside
   * an odd number of them. Only with a ColorArray. Default off.
   */
  vtkSetMacro(FillOutlines, vtkTypeBool);
  vtkGetMacro(FillOutlines, vtkTypeBool);
  vtkBooleanMacro(FillOutlines, vtkTypeBool);
  ///@}

  /**
   * What Order may be.
   */
  enum OrderType
  {
    ORDER_FILE = 0,
    ORDER_PATH = 1
  };

  ///@{
  /**
   * The order of the dots of each data set, in each layer. File (default): as they are. Path: along
   * a short path, for plotters.
   */
  vtkSetMacro(Order, int);
  vtkGetMacro(Order, int);
  void SetOrderToFile() { this->SetOrder(ORDER_FILE); }
  void SetOrderToPath() { this->SetOrder(ORDER_PATH); }
  const char* GetOrderAsString();
  ///@}

  ///@{
  /**
   * The colors of the values of a ColorArray that is not colors itself. Default: none, VTK's colors
   * from red to blue over the range of the values, or of the vectors' magnitudes.
   */
  void SetLookupTable(vtkScalarsToColors* table);
  vtkScalarsToColors* GetLookupTable() const { return this->LookupTable; }
  ///@}

  /**
   * Write the input to the file. Returns 1 on success, else 0.
   */
  int Write();

protected:
  vtkTransportVectorWriter();
  ~vtkTransportVectorWriter() override;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  /**
   * The format, on a file that outlives the result.
   */
  virtual std::unique_ptr<RectifiedTransport::Drawing> NewDrawing(
    RectifiedTransport::OutputFile& file) const = 0;

  char* FileName = nullptr;
  double Width = 100.0;
  double PageMargin = 0.0;
  double PageBounds[6] = {};
  double PointRadius = 0.0;
  double LineWidth = 0.0;
  vtkTypeBool FillOutlines = false;
  int Order = ORDER_FILE;
  vtkScalarsToColors* LookupTable = nullptr;

private:
  vtkTransportVectorWriter(const vtkTransportVectorWriter&) = delete;
  void operator=(const vtkTransportVectorWriter&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif

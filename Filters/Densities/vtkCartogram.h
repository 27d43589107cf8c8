// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCartogram
 * @brief   a map whose regions have areas in proportion to masses
 *
 * Moves the borders of regions, such as countries, until the area of each is its share of a mass,
 * such as a population. Passes of the rectified flow of Do, Coeurjolly, Memari and Bonneel
 * ("Linear-Time Transport with Rectified Flows", ACM Transactions on Graphics 44(4), 2025,
 * doi:10.1145/3731147) take a raster of the regions' densities to the uniform measure, until the
 * areas are within Tolerance. The raster is square and larger than the map; the ground around the
 * regions, the sea, has their mean density, so that land and sea keep their areas.
 *
 * Input 0: the regions, a vtkPolyData, a vtkUnstructuredGrid (as Threshold gives one) or a
 * composite of them (as ParaView's GDAL Vector Reader gives a map): polygons, or lines that end
 * where they begin, in one plane of any direction. What is inside an outline that crosses itself is
 * said by the even-odd rule. Open lines, such as rivers, move along; they have no share of the
 * area. Input array 0 (cells) is the mass of the region that a cell belongs to; by default the
 * active scalars, else the only numeric cell array, of one component. Input array 1 (cells,
 * optional) says which cells are one region: those with one value, which may be text. Without it
 * each block is a region, or each cell if the input is no composite. The mass of a region counts
 * once, and all its cells must have it. A ring inside an odd number of rings of its region is a
 * hole. Coordinates must be those of a map projection that keeps areas, or degrees of longitude and
 * latitude with Projection EqualArea.
 *
 * Input 1 (optional): the overlay, any vtkPointSet, such as rivers and cities, or a composite of
 * them, that moves along.
 *
 * Output 0, "Regions": a vtkPolyData with the cells of the input, all blocks together, lines first,
 * in their order and direction; those of an unstructured grid as vertices, lines, polygons.
 * Long edges are divided; both sides of a border stay the same. Point data are interpolated, cell
 * data kept. Cell data `AreaError` is a region's share of the area divided by its share of the
 * mass, less 1; `TargetArea` its area without error; `MassPerArea` its mass by its area in the
 * input. Field data `AreaErrors` has the largest absolute error after each pass, `EnlargedRegions`
 * how many regions MinimumShare enlarged, `RegionsMissed` how many miss Tolerance. Output 1,
 * "Graticule": lines of a regular grid over the map, moved. Output 2, "Overlay": the overlay with
 * all its data, moved.
 *
 * Cost: O(Resolution^2 + points * steps) a pass. Memory: about 50 bytes a cell of the raster.
 *
 * @sa vtkDensityEqualizingWarp vtkEqualMassCells
 */
#ifndef vtkCartogram_h
#define vtkCartogram_h

#include "vtkCollectiveAlgorithm.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkRectifiedTransportDensitiesModule.h" // for the export macro

#include <memory> // for std::unique_ptr

VTK_ABI_NAMESPACE_BEGIN
class vtkAlgorithmOutput;

class VTKRECTIFIEDTRANSPORTDENSITIES_EXPORT vtkCartogram : public vtkCollectiveAlgorithm
{
public:
  static vtkCartogram* New();
  vtkTypeMacro(vtkCartogram, vtkCollectiveAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The number of cells of the raster along each axis, 16 to 16384. Default 1024.
   */
  vtkSetMacro(Resolution, int);
  vtkGetMacro(Resolution, int);
  ///@}

  ///@{
  /**
   * How far the raster reaches beyond the map on each side, as a part of the map's longest side, 0
   * to 10. Default 0.1.
   */
  vtkSetMacro(Margin, double);
  vtkGetMacro(Margin, double);
  ///@}

  /**
   * What Projection may be.
   */
  enum ProjectionType
  {
    PROJECTION_NONE = 0,
    PROJECTION_EQUAL_AREA = 1
  };

  ///@{
  /**
   * What is done to the coordinates first. None (default): nothing. EqualArea: they are longitudes
   * and latitudes in degrees, and become kilometres of Lambert's cylindrical equal-area projection,
   * with the least bending of shapes at the middle of the map's latitudes. All outputs are in this
   * projection.
   */
  vtkSetMacro(Projection, int);
  vtkGetMacro(Projection, int);
  void SetProjectionToNone() { this->SetProjection(PROJECTION_NONE); }
  void SetProjectionToEqualArea() { this->SetProjection(PROJECTION_EQUAL_AREA); }
  const char* GetProjectionAsString();
  ///@}

  ///@{
  /**
   * The density of the ground around the regions. Mean (default): that of all regions together.
   * Minimum: the least of a region. Value: EmptyValue. Zero: nothing, so that regions fill the box.
   */
  vtkSetMacro(EmptyCells, int);
  vtkGetMacro(EmptyCells, int);
  void SetEmptyCellsToMean() { this->SetEmptyCells(EMPTY_CELLS_MEAN); }
  void SetEmptyCellsToMinimum() { this->SetEmptyCells(EMPTY_CELLS_MINIMUM); }
  void SetEmptyCellsToValue() { this->SetEmptyCells(EMPTY_CELLS_VALUE); }
  void SetEmptyCellsToZero() { this->SetEmptyCells(EMPTY_CELLS_ZERO); }
  const char* GetEmptyCellsAsString();
  ///@}

  ///@{
  /**
   * With EmptyCells Value, the density around the regions, as mass per area of the input, at least
   * 0. Default 0.
   */
  vtkSetMacro(EmptyValue, double);
  vtkGetMacro(EmptyValue, double);
  ///@}

  ///@{
  /**
   * The largest relative error that the area of a region may have, above 0 and at most 1. Default
   * 0.01.
   */
  vtkSetMacro(Tolerance, double);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * The most passes, 1 to 100. Default 10.
   */
  vtkSetMacro(MaximumIterations, int);
  vtkGetMacro(MaximumIterations, int);
  ///@}

  ///@{
  /**
   * Regions with less than this share of all mass are enlarged to it, from 0 to 1; from 1 / the
   * number of regions on, all become equal. Default 0.
   */
  vtkSetMacro(MinimumShare, double);
  vtkGetMacro(MinimumShare, double);
  ///@}

  ///@{
  /**
   * The part of the way from the map (0) to the cartogram (1), from 0 to 1. Default 1.
   */
  vtkSetMacro(Blend, double);
  vtkGetMacro(Blend, double);
  ///@}

  /**
   * Set the overlay (input 1), as the output of another filter.
   */
  void SetOverlayConnection(vtkAlgorithmOutput* overlay) { this->SetInputConnection(1, overlay); }

  /**
   * The same, as a data object.
   */
  void SetOverlayData(vtkDataObject* overlay) { this->SetInputData(1, overlay); }

  ///@{
  /**
   * The outputs; the overlay's is nullptr if it is a composite: GetOutputDataObject(2).
   */
  vtkPolyData* GetRegions() { return vtkPolyData::SafeDownCast(this->GetOutputDataObject(0)); }
  vtkPolyData* GetGraticule() { return vtkPolyData::SafeDownCast(this->GetOutputDataObject(1)); }
  vtkPointSet* GetOverlay() { return vtkPointSet::SafeDownCast(this->GetOutputDataObject(2)); }
  ///@}

protected:
  vtkCartogram();
  ~vtkCartogram() override;

  int RequestDataObject(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  int Resolution = 1024;
  double Margin = 0.1;
  int Projection = PROJECTION_NONE;
  int EmptyCells = EMPTY_CELLS_MEAN;
  double EmptyValue = 0.0;
  double Tolerance = 0.01;
  int MaximumIterations = 10;
  double MinimumShare = 0.0;
  double Blend = 1.0;

private:
  struct vtkInternals;
  std::unique_ptr<vtkInternals> Internals;

  vtkCartogram(const vtkCartogram&) = delete;
  void operator=(const vtkCartogram&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif

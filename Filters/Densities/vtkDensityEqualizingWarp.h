// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDensityEqualizingWarp
 * @brief   move points so that a density becomes uniform
 *
 * Moves the points of any vtkPointSet by the map that takes a density to the uniform measure on its
 * domain: space expands where the density is high and contracts where it is low. A map of a country
 * becomes a cartogram. The map is the rectified flow of Do, Coeurjolly, Memari and Bonneel,
 * "Linear-Time Transport with Rectified Flows", ACM Transactions on Graphics 44(4), 2025,
 * doi:10.1145/3731147, backward in time (Section 4.2). It is the inverse of the map of
 * vtkTransportSampler. Neither is an optimal transport, unless Method is Optimal.
 *
 * Input 0 is the vtkPointSet. Input 1 is the density, a data set (see vtkDensityAlgorithm), chosen
 * with SetInputArrayToProcess(0, 1, 0, ...). The output has the type of input 0: the same points
 * and cells in the same order with all their data. The points are moved and double. Point data
 * `Displacement` (the new position minus the old one, 3 components in physical units, active
 * vectors) replaces an array of the same name.
 *
 * If the density has one or two dimensions, points off the image's line or plane move as their
 * projections onto it and keep their offset. A point outside the domain moves as the nearest point
 * of the border (axis by axis) and keeps its offset from it. The field data `OutsidePoints` is
 * the number of such points; a warning counts them if they are at least one in a thousand. NaN or
 * infinite coordinates are an error.
 *
 * The field data `FoldedCells` is the number of the input's cells that turned over: their signed
 * area seen along the normal of a 2D density, signed volume in a 3D one, signed length along a 1D
 * one, changed its sign or became 0 although it was not. It is that of the simplices that VTK
 * divides a cell into: cells of higher order count by all of their points, warped faces by the
 * diagonals that VTK takes. The faces of polyhedra are seen from outside, as VTK defines them.
 * Ghost cells do not count, nor cells that VTK cannot divide. A warning says how many there are if
 * they are at least one in a thousand, or that of the area.
 *
 * With Method Optimal or Certify, and Blend above 0, there are also the field data `TransportCost`,
 * the mean squared displacement of the density's mass, by the centres of its cells, and
 * `TransportCostLowerBound` and `OptimalityGap` (see vtkTransportAlgorithm). They are those of the
 * whole map, whatever Blend is.
 *
 * Cost: O(cells) for the tables, which are kept until the density changes, and O(points * steps).
 * Memory: 48 bytes a point for the output and, while it runs, 16 more in 2D, plus the tables (see
 * vtkTransportAlgorithm).
 *
 * @warning Regions without mass contract to nothing: their points coincide with points of other
 * regions, up to the error of the integrator. To keep them open, add a small number to the density.
 * @warning Normals are passed on unchanged, although the surface is deformed.
 *
 * \code{.cpp}
 * vtkNew<vtkDensityEqualizingWarp> warp;
 * warp->SetInputData(borders);    // a vtkPolyData
 * warp->SetDensityData(people);   // a vtkImageData
 * warp->Update();
 * vtkPointSet* cartogram = warp->GetOutput();
 * \endcode
 *
 * @sa vtkTransportSampler vtkTransportAlgorithm vtkDensityAlgorithm vtkWarpVector
 */
#ifndef vtkDensityEqualizingWarp_h
#define vtkDensityEqualizingWarp_h

#include "vtkPointSet.h"
#include "vtkRectifiedTransportDensitiesModule.h" // for the export macro
#include "vtkTransportAlgorithm.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkAlgorithmOutput;

class VTKRECTIFIEDTRANSPORTDENSITIES_EXPORT vtkDensityEqualizingWarp : public vtkTransportAlgorithm
{
public:
  static vtkDensityEqualizingWarp* New();
  vtkTypeMacro(vtkDensityEqualizingWarp, vtkTransportAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The fraction of the displacement that is applied, in [0,1]: 0 leaves the points unmoved, 1
   * (default) is the whole map.
   */
  vtkSetMacro(Blend, double);
  vtkGetMacro(Blend, double);
  ///@}

  ///@{
  /**
   * What empty cells count as: cells that are blanked or without a valid value, and ground that
   * data other than images do not cover. Mean (default): the mean of the other cells, so that empty
   * ground keeps its size. Minimum: the least of the other cells. Zero: nothing, which shrinks
   * empty ground to nothing. Value: EmptyValue.
   */
  vtkSetMacro(EmptyCells, int);
  vtkGetMacro(EmptyCells, int);
  void SetEmptyCellsToZero() { this->SetEmptyCells(EMPTY_CELLS_ZERO); }
  void SetEmptyCellsToMean() { this->SetEmptyCells(EMPTY_CELLS_MEAN); }
  void SetEmptyCellsToMinimum() { this->SetEmptyCells(EMPTY_CELLS_MINIMUM); }
  void SetEmptyCellsToValue() { this->SetEmptyCells(EMPTY_CELLS_VALUE); }
  const char* GetEmptyCellsAsString();
  ///@}

  ///@{
  /**
   * The density of empty cells with EmptyCells Value, finite and at least 0. Default 0.
   */
  vtkSetMacro(EmptyValue, double);
  vtkGetMacro(EmptyValue, double);
  ///@}

  ///@{
  /**
   * Empty cells around the density: its box grows by this share of its longest axis on every side
   * of every axis, rounded up to whole cells. From 0 (default) to 10. Empty ground around a map
   * lets its border move. With EmptyCells Zero it contracts to nothing.
   */
  vtkSetMacro(Margin, double);
  vtkGetMacro(Margin, double);
  ///@}

  ///@{
  /**
   * Whether the map is corrected until the areas (volumes) of the density's cells are their
   * masses. Once for a density and the settings of the flow, the corners of all its cells are moved
   * back and Poisson's equation is solved on their images; points move as the corners do,
   * interpolated. The field data `EqualAreaPasses` says how many of
   * two corrections were kept, because they made errors of areas smaller and no more cells of the
   * density fold. A warning says if it is 0, else there is no `AreaErrorEstimate`: it would be that
   * of the flow alone. `FoldedCells` may rise all the same, as it counts cells of input 0. Needs
   * whole tables. Default off.
   */
  vtkSetMacro(EqualizeAreas, vtkTypeBool);
  vtkGetMacro(EqualizeAreas, vtkTypeBool);
  vtkBooleanMacro(EqualizeAreas, vtkTypeBool);
  ///@}

  /**
   * Set the density (input 1), as the output of another filter.
   */
  void SetDensityConnection(vtkAlgorithmOutput* density) { this->SetInputConnection(1, density); }

  /**
   * The same, as a data object.
   */
  void SetDensityData(vtkDataObject* density) { this->SetInputData(1, density); }

  /**
   * The moved points, with the vtkCells and attribute data of the input.
   */
  vtkPointSet* GetOutput() { return vtkPointSet::SafeDownCast(this->GetOutputDataObject(0)); }

protected:
  vtkDensityEqualizingWarp();
  ~vtkDensityEqualizingWarp() override = default;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  double Blend = 1.0;
  double Margin = 0.0;
  vtkTypeBool EqualizeAreas = false;

private:
  vtkDensityEqualizingWarp(const vtkDensityEqualizingWarp&) = delete;
  void operator=(const vtkDensityEqualizingWarp&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif

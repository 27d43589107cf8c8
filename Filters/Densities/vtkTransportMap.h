// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTransportMap
 * @brief   the map between the uniform measure and a density, or between two densities, as fields
 *          of an image
 *
 * Follows the rectified flow (equation 12) of Do, Coeurjolly, Memari and Bonneel, "Linear-Time
 * Transport with Rectified Flows", ACM Transactions on Graphics 44(4), 2025,
 * doi:10.1145/3731147, from one point in each cell of an image: forward, from the uniform measure
 * to the density, or backward (Section 4.2), from the density to the uniform measure. With Method
 * Optimal the map is that of least cost.
 *
 * The input is the density, a data set (see vtkDensityAlgorithm). The output is a vtkImageData
 * on the same domain with
 * - `Displacement` (active vectors): the mapped sample minus the sample; 3 components in physical
 *   units along the physical axes;
 * - `Divergence`: the trace of the gradient of Displacement;
 * - `JacobianDeterminant`: the determinant of the map x + Displacement(x), det(I + gradient). Where
 *   the density f is positive and smooth, it is mean / f(x + Displacement) forward and f(x) / mean
 *   backward;
 * - field data `TotalMass` (density times cell measure, summed) and `TransportCost` (the mean of
 *   |Displacement|^2, in physical units), `MovedSamples` (those that ended in an empty cell and
 *   were put on the nearest mass; a warning counts them if they are at least one in a thousand),
 *   `FoldedCells` and `LargestBlockError`, and the input's field data; with Method Optimal or
 *   Certify also `TransportCostLowerBound` and `OptimalityGap` (see vtkTransportAlgorithm).
 *
 * If the density is point data, so are the arrays, at the image's points, the centres of the dual
 * cells. Otherwise they are cell data, at the centres of the cells. Derivatives are taken only
 * along the image's axes of more than one point, by central differences, one-sided at the border.
 * Along an axis of one sample, Displacement is taken as constant. In the corners of the domain, in
 * 3D also at its edges, the map has no derivative: the determinants of samples there are wrong at
 * any resolution.
 *
 * `FoldedCells` is the number of samples at which the map turns space over: JacobianDeterminant is
 * 0 or negative, and (DensityToUniform) the density has mass in the sample's cell. A warning says
 * how many there are if they are at least one in a thousand of those with mass, or cover a
 * thousandth of the domain. The two outermost samples along at least two axes do not count, because
 * they are next to a corner or an edge.
 *
 * `LargestBlockError` has two components, the 99.9 % quantile and the largest of the relative
 * errors of blocks. A block reaches over 4 spacings of samples along each axis, from the first
 * sample on; its image is the polygon (2D) or polyhedron (3D) of the images of its samples, with
 * negative measure where it is turned over.
 * - UniformToDensity: |m - s| / s, where m is the density's share of the mass in the image and s
 *   the block's share of the domain. In 3D m of the 5 % of blocks with the largest errors is exact;
 *   one point for each triangle of the polyhedra finds these blocks, and the other ones count as
 *   better.
 * - DensityToUniform: |a - m| / m, where a is the image's share of the domain and m the block's
 *   share of the mass. Only blocks count in which every cell of the density has more than 5 % of
 *   the mean.
 *
 * Both are NaN if there is no such block: with fewer than 5 samples along an axis, or too little
 * mass everywhere. Number floor(0.999 n) of the n errors in ascending order, from 0, is the
 * quantile.
 *
 * TransportCost is the mean over the measure that the map starts from: forward the mean of all
 * samples, backward weighted by the density's mass in each sample's cell. The map takes this
 * measure to the other one, up to the integrator's error and the spacing of the samples. The cost
 * is therefore an upper bound on the squared 2-Wasserstein distance between the density, per unit
 * of mass, and the uniform measure.
 *
 * The output has the input's geometry unless SampleDimensions are set. If it has, the input's point
 * and cell data are passed on.
 *
 * Cost: O(cells) for the tables and O(samples * steps) for the flow. The tables serve both
 * directions and all SampleDimensions and are kept until the density changes. Memory: 40 bytes a
 * sample for the output and, while it runs, 16 more in 2D, plus the tables (see
 * vtkTransportAlgorithm), and at the end 34 MB or a layer of the density for the blocks.
 *
 * Input port 1, which may stay empty, is a second density, the target. The map then leads from the
 * first density to the target, each divided by its mass, and the output has samples on the domain
 * of the first one:
 * - Displacement ends in the target. RectifiedFlow takes the backward flow to the uniform measure
 *   and from there the forward flow to the target: points of the two unit boxes correspond, as in
 *   vtkTransportInterpolator. Optimal solves the map between both densities;
 * - where both densities f and g, each divided by its mass, are smooth and positive,
 *   JacobianDeterminant is f(x) / g(x + Displacement);
 * - `CostDensity`: the share of the mass in the sample's cell times |Displacement|^2; its sum is
 *   TransportCost;
 * - TransportCost is the mean over the mass, an upper bound on the squared 2-Wasserstein distance
 *   between the densities, each divided by its mass. TotalMass is that of the first density;
 * - the errors of LargestBlockError are |m - s| / s: m is the target's share of the mass in the
 *   image of the block, s the first density's share of the mass in the block. Only blocks count in
 *   which every cell of the first density has more than 5 % of the mean;
 * - StepsTaken and AreaErrorEstimate have two values, of the flow back and of the flow on;
 * - MovedSamples counts samples that ended in empty cells of the target, and FoldedCells those with
 *   mass in their cell.
 *
 * With Direction DensityToUniform the map leads from the target to the first density, as with both
 * inputs exchanged: the output then has the grid and the arrays of the target. EqualizeAreas has no
 * effect. The target's array is input array 1 (SetInputArrayToProcess(1, 1, ...)). The two may
 * differ in size, spacing and box; other dimensions, planes or direction matrices are an error.
 * Both tables, and the optimal map between both, are kept.
 *
 * With several MPI ranks, each rank has the extent that is requested of it. Without MPI, piece 0
 * holds all data.
 *
 * @warning A sample where the density is 0 has no inverse. Backward, it keeps its relative position
 * in the box of its possible destinations until this box has mass; the map is not one to one there.
 * Where the density is low, the map needs more NumberOfSteps than elsewhere.
 *
 * @sa vtkTransportSampler vtkTransportInterpolator vtkTransportAlgorithm vtkDensityAlgorithm
 */
#ifndef vtkTransportMap_h
#define vtkTransportMap_h

#include "vtkImageData.h"
#include "vtkRectifiedTransportDensitiesModule.h" // for the export macro
#include "vtkTransportAlgorithm.h"

namespace RectifiedTransport
{
namespace Bridge
{
struct TargetCache;
} // namespace Bridge
} // namespace RectifiedTransport

VTK_ABI_NAMESPACE_BEGIN
class vtkAlgorithmOutput;

class VTKRECTIFIEDTRANSPORTDENSITIES_EXPORT vtkTransportMap : public vtkTransportAlgorithm
{
public:
  static vtkTransportMap* New();
  vtkTypeMacro(vtkTransportMap, vtkTransportAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * What Direction may be.
   */
  enum DirectionType
  {
    UNIFORM_TO_DENSITY = 0,
    DENSITY_TO_UNIFORM = 1
  };

  /**
   * Set the target (input 1), as the output of another filter; nullptr for none.
   */
  void SetTargetConnection(vtkAlgorithmOutput* target) { this->SetInputConnection(1, target); }

  /**
   * The same, as a data object.
   */
  void SetTargetData(vtkDataObject* target) { this->SetInputData(1, target); }

  using vtkAlgorithm::SetInputArrayToProcess;
  /**
   * Choose the array of a density. With port 1 it is that of the target, input array 1, even if
   * `idx` is 0, which ParaView passes by default.
   */
  void SetInputArrayToProcess(
    int idx, int port, int connection, int fieldAssociation, const char* name) override;

  ///@{
  /**
   * The direction of the map. UniformToDensity (default) takes the uniform measure to the density.
   * DensityToUniform is the inverse map. With a target: from the density to the target, and from
   * the target to the density.
   */
  vtkSetMacro(Direction, int);
  vtkGetMacro(Direction, int);
  void SetDirectionToUniformToDensity() { this->SetDirection(UNIFORM_TO_DENSITY); }
  void SetDirectionToDensityToUniform() { this->SetDirection(DENSITY_TO_UNIFORM); }
  const char* GetDirectionAsString();
  ///@}

  ///@{
  /**
   * The number of values of the output along the image's x, y and z, on the same domain. 0: as many
   * as the density. At least 0 each; 0 or 1 along an axis of one point; for point data 0 or at
   * least 2 along the other axes. Default 0 0 0.
   */
  vtkSetVector3Macro(SampleDimensions, int);
  vtkGetVector3Macro(SampleDimensions, int);
  ///@}

  ///@{
  /**
   * What empty cells count as: cells that are blanked or without a valid value, and ground that
   * data other than images do not cover. Zero (default): nothing. Mean: the mean of the other
   * cells. Minimum: the least of the other cells. Value: EmptyValue.
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
   * Whether the map of DensityToUniform is corrected until the areas (volumes) of the density's
   * cells are their masses. Once for a density and the settings of the flow, the corners of all its
   * cells are moved back and Poisson's equation is solved on their images; samples move as the
   * corners do, interpolated. The field data `EqualAreaPasses` says how many of
   * two corrections were kept, because they made errors of areas smaller and no more cells of the
   * density fold. A warning says if it is 0, else there is no `AreaErrorEstimate`: it would be that
   * of the flow alone. `FoldedCells` may rise all the same, as it counts samples. Needs whole
   * tables. Default off.
   */
  vtkSetMacro(EqualizeAreas, vtkTypeBool);
  vtkGetMacro(EqualizeAreas, vtkTypeBool);
  vtkBooleanMacro(EqualizeAreas, vtkTypeBool);
  ///@}

  /**
   * The image with the map's fields.
   */
  vtkImageData* GetOutput() { return vtkImageData::SafeDownCast(this->GetOutputDataObject(0)); }

protected:
  vtkTransportMap();
  ~vtkTransportMap() override;

  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  int Direction = UNIFORM_TO_DENSITY;
  int SampleDimensions[3] = { 0, 0, 0 };
  vtkTypeBool EqualizeAreas = false;

private:
  bool ReadPair(vtkInformationVector** inputVector, RectifiedTransport::Progress& progress,
    std::unique_ptr<RectifiedTransport::Bridge::InputDensity>* densities);
  // Kept while there is a target.
  std::unique_ptr<RectifiedTransport::Bridge::TargetCache> ToTarget;

  vtkTransportMap(const vtkTransportMap&) = delete;
  void operator=(const vtkTransportMap&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif

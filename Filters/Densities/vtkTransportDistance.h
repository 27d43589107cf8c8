// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTransportDistance
 * @brief   the distances between several densities, by transport, as tables
 *
 * The distance of two densities is W2, the 2-Wasserstein distance: the root of the least mean
 * squared distance by which the mass of one can be moved to the other, each divided by its mass, in
 * physical lengths. Densities are constant on their cells.
 *
 * Inputs: two or more data sets, as connections to port 0 or as the blocks of a composite data set
 * (vtkMultiBlockDataSet, vtkPartitionedDataSetCollection), in their order; or, with OverTime, the
 * time steps of one input. The one density array (SetInputArrayToProcess(0, 0, ...)) is looked up
 * in all of them. All must fill the same box, along the same axes in the same directions. The
 * outputs are vtkTables:
 * - port 0, Distances: a row and a column for each input. Columns have the names of the inputs (see
 *   SetInputName), those of the blocks, or `t = ` and the time.
 * - port 1, Bounds: a row for each pair: `First`, `Second` (numbers of rows of Distances, from 0),
 *   `LowerBound` and `UpperBound`.
 * - port 2, Coordinates: a row for each input: `Coordinate0` ..., points whose distances are as
 * near as possible to those of port 0, by classical scaling; `Name`, `Time` (with OverTime) and
 *   `TotalMass`. Field data `Stress`: the root of sum (d - e)^2 / sum d^2 over all pairs, where d
 *   are the distances and e those of the points.
 *
 * Method Linearized takes one optimal map for each input, from the uniform measure on the box,
 * after Wang, Slepcev, Basu, Ozolek and Rohde, "A linear optimal transportation framework for
 * quantifying and visualizing variations in sets of images", International Journal of Computer
 * Vision 101, 2013, doi:10.1007/s11263-012-0566-z. A distance is the root of the mean squared
 * distance of the images of 65536 samples: a true metric, and an upper estimate of W2. It depends
 * on the two densities alone, not on the others. LowerBound is that of the means and covariances
 * (Gelbrich 1990), which is certified. UpperBound is the distance, which is not.
 *
 * Method Certified solves each pair. Distances are the roots of the lower bounds: they are mostly
 * less than 1 % below W2. LowerBound and UpperBound are certified, up to rounding (see OptimalMap.h
 * in the core): UpperBound is the cost of a coupling of exactly these densities. All inputs must
 * have the same number of cells along each axis.
 *
 * What was computed is kept by the content of the densities. An input that is added costs its map,
 * or its pairs; another order or names cost nothing.
 *
 * Cost: Linearized, a map each and O(65536) a pair; Certified, a solution a pair; then O(n^3) for n
 * inputs. Memory: Linearized, 0.5, 1 or 1.5 MB each (1D, 2D, 3D) and at most 16 densities at a
 * time; Certified, 8 bytes a cell of each.
 *
 * If MPI ranks request one piece each, they run the filter together: maps and pairs are divided
 * among them. Rank 0 has the tables, bitwise as on one rank.
 *
 * @sa vtkTransportMap vtkTransportBarycenter
 */
#ifndef vtkTransportDistance_h
#define vtkTransportDistance_h

#include "vtkDensityAlgorithm.h"
#include "vtkRectifiedTransportDensitiesModule.h" // for the export macro
#include "vtkTable.h"

#include <memory> // for std::unique_ptr
#include <string> // for texts

VTK_ABI_NAMESPACE_BEGIN
class VTKRECTIFIEDTRANSPORTDENSITIES_EXPORT vtkTransportDistance : public vtkDensityAlgorithm
{
public:
  static vtkTransportDistance* New();
  vtkTypeMacro(vtkTransportDistance, vtkDensityAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * What Method may be.
   */
  enum MethodType
  {
    LINEARIZED = 0,
    CERTIFIED = 1
  };

  /**
   * What MassDifference may be.
   */
  enum MassDifferenceType
  {
    MASS_DIFFERENCE_NORMALIZE = 0,
    MASS_DIFFERENCE_ERROR = 1
  };

  ///@{
  /**
   * How distances are found. Linearized (default): one map for each input, an upper estimate.
   * Certified: a solution for each pair, with certified bounds.
   */
  vtkSetMacro(Method, int);
  vtkGetMacro(Method, int);
  void SetMethodToLinearized() { this->SetMethod(LINEARIZED); }
  void SetMethodToCertified() { this->SetMethod(CERTIFIED); }
  const char* GetMethodAsString();
  ///@}

  ///@{
  /**
   * What to do where the inputs have different masses. Normalize (default): divide each by its
   * mass; a warning says so if the largest mass is more than 1 % above the smallest. Error: stop,
   * if they differ by more than a millionth.
   */
  vtkSetMacro(MassDifference, int);
  vtkGetMacro(MassDifference, int);
  void SetMassDifferenceToNormalize() { this->SetMassDifference(MASS_DIFFERENCE_NORMALIZE); }
  void SetMassDifferenceToError() { this->SetMassDifference(MASS_DIFFERENCE_ERROR); }
  const char* GetMassDifferenceAsString();
  ///@}

  ///@{
  /**
   * Take the time steps of the one input instead of several inputs. All of them are requested, one
   * after the other. A composite data set is then one density. Off by default.
   */
  vtkSetMacro(OverTime, vtkTypeBool);
  vtkGetMacro(OverTime, vtkTypeBool);
  vtkBooleanMacro(OverTime, vtkTypeBool);
  ///@}

  ///@{
  /**
   * The number of coordinates of port 2, 1 to 100. Those that the distances do not need are 0.
   * Default 2.
   */
  vtkSetMacro(NumberOfCoordinates, int);
  vtkGetMacro(NumberOfCoordinates, int);
  ///@}

  ///@{
  /**
   * How many connections have names. The count is at most 1000000. By default none.
   */
  void SetNumberOfInputNames(int count);
  int GetNumberOfInputNames();
  ///@}

  ///@{
  /**
   * The name of the input of a connection, for the columns. The list grows as needed. Without a
   * name it is `Input` and its number from 1. The name of a block comes before that of its
   * connection.
   */
  void SetInputName(int connection, const char* name);
  const char* GetInputName(int connection);
  ///@}

  /**
   * How many maps (Linearized) and pairs (Certified) have been solved since the filter was made.
   * What is kept is not solved again.
   */
  vtkIdType GetNumberOfSolutions();

  /**
   * The matrix of distances, output port 0.
   */
  vtkTable* GetDistances() { return vtkTable::SafeDownCast(this->GetOutputDataObject(0)); }

  /**
   * The bounds of all pairs, output port 1.
   */
  vtkTable* GetBounds() { return vtkTable::SafeDownCast(this->GetOutputDataObject(1)); }

  /**
   * The points, output port 2.
   */
  vtkTable* GetCoordinates() { return vtkTable::SafeDownCast(this->GetOutputDataObject(2)); }

protected:
  vtkTransportDistance();
  ~vtkTransportDistance() override;

  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  void EndPasses() override;

  int Method = LINEARIZED;
  int MassDifference = MASS_DIFFERENCE_NORMALIZE;
  vtkTypeBool OverTime = false;
  int NumberOfCoordinates = 2;

private:
  struct vtkInternals;

  bool AddInputs(vtkInformationVector** inputVector, RectifiedTransport::Progress& progress);
  bool AddStep(vtkInformationVector** inputVector, RectifiedTransport::Progress& progress);
  bool Add(vtkDataObject* data, const std::string& title, const std::string& name, int number,
    double time, RectifiedTransport::Progress& progress);
  void CheckMasses();

  std::unique_ptr<vtkInternals> Internals;

  vtkTransportDistance(const vtkTransportDistance&) = delete;
  void operator=(const vtkTransportDistance&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif

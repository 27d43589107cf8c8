// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkBlueNoiseRelaxation
 * @brief   space points evenly where they follow a density
 *
 * Moves points, iteration by iteration, until they have the spectrum of blue noise and are as dense
 * as a density: even distances, without clumps, holes and rows. It takes any start, and is best
 * with the particles of vtkTransportSampler, which follow the density already: relaxation alone
 * carries mass over long ways slowly (Do, Coeurjolly, Memari and Bonneel, "Linear-Time Transport
 * with Rectified Flows", ACM Transactions on Graphics 44(4), 2025, doi:10.1145/3731147,
 * Section 5.1).
 *
 * Input 0 is the points, any vtkPointSet, input 1 the density, a data set of two or three
 * dimensions (see vtkDensityAlgorithm), chosen with SetInputArrayToProcess(0, 1, 0, ...). The
 * output is of the type of input 0: the same points and cells in the same order with all their
 * data, the points moved and double. Arrays are passed on as they are, also those that tell of the
 * points' places, such as `Displacement`. On several ranks of MPI
 * all points and the density are gathered on the first one, which has the output; in other
 * programs piece 0 holds all.
 *
 * Field data `Energy` (double) has the energy that the method lowers: the first value is that of
 * the points before the first iteration, and each iteration adds one, which is never greater than
 * the one before it. There are at most MaximumIterations + 1, and none where all points are ghosts.
 * It has no unit.
 *
 * - GaussianBlueNoise (Ahmed, Ren and Wonka, "Gaussian Blue Noise", ACM Transactions on Graphics
 *   41(6), 2022): points repel each other by Gaussians as wide as their distance at the local
 *   density, and the density attracts them. The energy is the squared difference, for each point,
 *   of the points and the density with their number as its mass, both blurred by such Gaussians: 1
 *   on average for points at random, 0 at best.
 * - OptimalTransport (de Goes, Breeden, Ostromoukhov and Desbrun, "Blue Noise through Optimal
 *   Transport", ACM Transactions on Graphics 31(6), 2012): the weights of a power diagram that give
 *   all points equal masses, then the points to the centroids of their cells. For densities of two
 *   dimensions. With N points, the density's mass M, the area A of its domain and C(i) the cell of
 *   point x(i), the energy is N / (M A) times the sum over i of the integral over C(i) of density
 *   times |x - x(i)|^2. A hexagonal lattice in a uniform density has 5 sqrt(3) / 54 = 0.1604. The
 *   masses are equal to 1e-6 of their mean. Where a centroid has no mass, the point goes to the
 *   nearest cell of the density that has.
 *
 * Points outside of the domain, and off the plane of a density of two dimensions, are moved to the
 * nearest point of the domain (axis by axis) first; one warning counts those that are farther from
 * it than a millionth of its diagonal. Of points that coincide (OptimalTransport: to 1e-5 of their
 * mean distance) all but one are moved a little.
 * Points that the ghost array marks as duplicate or hidden stay where they are, and the others do
 * not see them. NaN or infinite coordinates are an error. An input without points gives an empty
 * output without an error.
 *
 * Cost: GaussianBlueNoise O(cells) for the tables, which are kept until the density changes, and
 * O(n) for n points in each iteration; OptimalTransport O(cells) once, then O(n log n)
 * for the cells and O(n^1.5) for the linear system of each step of Newton's method, of which an
 * iteration has several, and no tables. Memory: 24 bytes a point for the output
 * and while it runs, GaussianBlueNoise about 2.5 kB a point in two dimensions and 4.6 kB in three
 * beside the tables, OptimalTransport about 2 kB a point and 18 bytes a cell of the density. The
 * results are the same to the last bit for every number of threads.
 *
 * @warning With OptimalTransport, points far from distributed like a density with large holes or
 * narrow peaks, such as random ones, take long for the weights before the first iteration:
 * hundreds of them seconds, thousands a minute. Begin with particles of the density. Where no
 * weights are found, that is an error.
 * @warning Axes of the image that are not perpendicular count as if they were.
 *
 * \code{.cpp}
 * vtkNew<vtkTransportSampler> sampler;
 * sampler->SetInputData(image);
 * vtkNew<vtkBlueNoiseRelaxation> relaxation;
 * relaxation->SetInputConnection(sampler->GetOutputPort());
 * relaxation->SetDensityData(image);
 * relaxation->SetMethodToOptimalTransport();
 * relaxation->Update();
 * vtkDataArray* energy = relaxation->GetOutput()->GetFieldData()->GetArray("Energy");
 * \endcode
 *
 * @sa vtkTransportSampler vtkTransportQuality vtkDensityAlgorithm
 */
#ifndef vtkBlueNoiseRelaxation_h
#define vtkBlueNoiseRelaxation_h

#include "vtkDensityAlgorithm.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkAlgorithmOutput;
class vtkPointSet;

class VTKRECTIFIEDTRANSPORT_EXPORT vtkBlueNoiseRelaxation : public vtkDensityAlgorithm
{
public:
  static vtkBlueNoiseRelaxation* New();
  vtkTypeMacro(vtkBlueNoiseRelaxation, vtkDensityAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * What Method may be.
   */
  enum MethodType
  {
    GAUSSIAN_BLUE_NOISE = 0,
    OPTIMAL_TRANSPORT = 1
  };

  ///@{
  /**
   * How points are moved: GaussianBlueNoise (default) lets them repel each other by Gaussians, in
   * two and three dimensions; OptimalTransport moves them to the centroids of cells of equal mass,
   * in two.
   */
  vtkSetMacro(Method, int);
  vtkGetMacro(Method, int);
  void SetMethodToGaussianBlueNoise() { this->SetMethod(GAUSSIAN_BLUE_NOISE); }
  void SetMethodToOptimalTransport() { this->SetMethod(OPTIMAL_TRANSPORT); }
  const char* GetMethodAsString();
  ///@}

  ///@{
  /**
   * The number of iterations after which it ends at the latest, at least 0; with 0 only points
   * outside of the domain and points that coincide are moved. Default 50.
   */
  vtkSetMacro(MaximumIterations, int);
  vtkGetMacro(MaximumIterations, int);
  ///@}

  ///@{
  /**
   * It ends after an iteration that lowers the energy by at most this part of it, at least 0 and
   * less than 1; 0 where none does. Default 0.
   */
  vtkSetMacro(Tolerance, double);
  vtkGetMacro(Tolerance, double);
  ///@}

  /**
   * Set the density (input 1), as the output of another filter.
   */
  void SetDensityConnection(vtkAlgorithmOutput* density);

  /**
   * The same, as a data object.
   */
  void SetDensityData(vtkDataObject* density);

  /**
   * The moved points, with the vtkCells and attribute data of the input.
   */
  vtkPointSet* GetOutput();

protected:
  vtkBlueNoiseRelaxation();
  ~vtkBlueNoiseRelaxation() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  int Method;
  int MaximumIterations;
  double Tolerance;

private:
  vtkBlueNoiseRelaxation(const vtkBlueNoiseRelaxation&) = delete;
  void operator=(const vtkBlueNoiseRelaxation&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif

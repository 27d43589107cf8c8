// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkBlueNoiseRelaxation
 * @brief space points evenly while they follow a density
 *
 * Moves points iteratively until they follow a density and have the spectrum of blue noise: even
 * distances, without clumps, holes or rows. Any points can be the start. The particles of
 * vtkTransportSampler are best because they follow the density already; relaxation moves mass over
 * long distances slowly (Do, Coeurjolly, Memari and Bonneel, "Linear-Time Transport with Rectified
 * Flows", ACM Transactions on Graphics 44(4), 2025, doi:10.1145/3731147, Section 5.1).
 *
 * Input 0 is the points, any vtkPointSet. Input 1 is the density, a data set of two or three
 * dimensions (see vtkDensityAlgorithm), chosen with SetInputArrayToProcess(0, 1, 0, ...). The
 * output has the type of input 0: the same points and cells in the same order with all their data.
 * The points are moved and double. All arrays pass unchanged, even those that depend on positions,
 * such as `Displacement`. With several MPI ranks, all points and the density are gathered on rank
 * 0, which has the output. Without MPI, piece 0 holds all data.
 *
 * Field data `Energy` (double) has the energy that the method lowers, without a unit. The first
 * value is the energy before the first iteration. Each iteration adds a value that is never greater
 * than the one before it. There are at most MaximumIterations + 1 values, and none if all points
 * are ghosts.
 *
 * - GaussianBlueNoise (Ahmed, Ren and Wonka, "Gaussian Blue Noise", ACM Transactions on Graphics
 *   41(6), 2022): points repel each other by Gaussians as wide as their distance at the local
 *   density, and the density attracts them. The points and the density, scaled to their number, are
 *   blurred by such Gaussians; the energy is the squared difference of the two, for each point. It
 *   is 1 on average for random points, 0 at best.
 * - OptimalTransport (de Goes, Breeden, Ostromoukhov and Desbrun, "Blue Noise through Optimal
 *   Transport", ACM Transactions on Graphics 31(6), 2012): finds the weights of a power diagram
 *   that give all points equal masses, then moves the points to the centroids of their cells. For
 *   densities of two dimensions. With N points, the density's mass M, the area A of its domain and
 *   C(i) the cell of point x(i), the energy is N / (M A) times the sum over i of the integral over
 *   C(i) of density times |x - x(i)|^2. A hexagonal lattice in a uniform density has 5 sqrt(3) / 54
 *   = 0.1604. The masses are equal to 1e-6 of their mean. If a centroid has no mass, the point goes
 *   to the nearest cell of the density that has mass.
 *
 * Points outside the domain or off the plane of a density of two dimensions are moved to the
 * nearest point of the domain (axis by axis) first. The field data `OutsidePoints` is the number of
 * those that are farther from it than a millionth of its diagonal; a warning counts them if they
 * are at least one in a thousand. If points coincide (OptimalTransport: to 1e-5 of their mean
 * distance), all except one are moved a little. Points that the ghost array marks as duplicate or
 * hidden stay where they are and do not act on others. NaN or infinite coordinates are an error. An
 * input without points gives an empty output and no error.
 *
 * Cost of GaussianBlueNoise: O(cells) for the tables, which are kept until the density changes, and
 * O(n) for n points in each iteration. Cost of OptimalTransport: O(cells) once, without tables;
 * then O(n log n) for the cells and O(n^1.5) for the linear system in each Newton step, several an
 * iteration. Memory: 24 bytes a point for the output. While it runs, GaussianBlueNoise takes the
 * tables and about 2.5 kB a point in two dimensions, 4.6 kB in three; OptimalTransport about 2 kB a
 * point and 18 bytes a cell of the density. The results are bitwise the same for every number of
 * threads.
 *
 * @warning OptimalTransport: if the density has large holes or narrow peaks and the points do not
 * follow it, such as random points, the weights before the first iteration take long: about a
 * second for 500 points, up to half a minute for 4000. Begin with particles of the density. If no
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
#include "vtkPointSet.h"
#include "vtkRectifiedTransportDensitiesModule.h" // for the export macro

VTK_ABI_NAMESPACE_BEGIN
class vtkAlgorithmOutput;

class VTKRECTIFIEDTRANSPORTDENSITIES_EXPORT vtkBlueNoiseRelaxation : public vtkDensityAlgorithm
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
   * How points are moved. GaussianBlueNoise (default): they repel each other by Gaussians, in two
   * and three dimensions. OptimalTransport: they move to the centroids of cells of equal mass, in
   * two.
   */
  vtkSetMacro(Method, int);
  vtkGetMacro(Method, int);
  void SetMethodToGaussianBlueNoise() { this->SetMethod(GAUSSIAN_BLUE_NOISE); }
  void SetMethodToOptimalTransport() { this->SetMethod(OPTIMAL_TRANSPORT); }
  const char* GetMethodAsString();
  ///@}

  ///@{
  /**
   * The largest number of iterations, at least 0. 0 moves only points outside the domain and points
   * that coincide. Default 50.
   */
  vtkSetMacro(MaximumIterations, int);
  vtkGetMacro(MaximumIterations, int);
  ///@}

  ///@{
  /**
   * The relaxation ends after an iteration that lowers the energy by at most this fraction of it,
   * at least 0 and less than 1. With 0 it goes on while any iteration lowers the energy. Default 0.
   */
  vtkSetMacro(Tolerance, double);
  vtkGetMacro(Tolerance, double);
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
  vtkBlueNoiseRelaxation();
  ~vtkBlueNoiseRelaxation() override = default;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  int Method = GAUSSIAN_BLUE_NOISE;
  int MaximumIterations = 50;
  double Tolerance = 0.0;

private:
  vtkBlueNoiseRelaxation(const vtkBlueNoiseRelaxation&) = delete;
  void operator=(const vtkBlueNoiseRelaxation&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif

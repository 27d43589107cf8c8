// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTransportTemporalInterpolator
 * @brief   move the mass of a series of densities between its time steps
 *
 * At a time between two steps of the input, the mass of the first step is on its way to where it is
 * in the second: each particle moves on a straight line with constant speed.
 * vtkTemporalInterpolator would show both steps at once. The total mass between two steps is linear
 * in time.
 *
 * Input: a density (see vtkDensityAlgorithm) with TIME_STEPS; each step is requested when it is
 * needed, two for an interval. The outputs are
 * - port 0, Density: a vtkImageData with the density's array, under its name (active scalars,
 *   doubles; mass per length, area or volume), point or cell data as in the input;
 * - port 1, Particles: a vtkPolyData with one vertex a particle, `Mass` and `Velocity` (3
 *   components, physical length by time; active vectors).
 * Both have the field data `TotalMass`, `TransportCost` (the mean squared distance of the interval,
 * over the mass of its first step) and, with Optimal, `TransportCostLowerBound` and `OptimalityGap`
 * (see vtkTransportAlgorithm).
 *
 * Particles start in the cells of both steps, with the masses of these cells: those of the first
 * step move to the second and fade linearly, those of the second step come from the first and grow.
 * Both sets are of the same density on its way. At a step itself port 0 is the density of the
 * input, bitwise, and port 1 has the particles of that step alone. A time before the first step or
 * after the last one is that one.
 *
 * With TrackParticles, port 1 has the same particles at all times, with equal shares of the mass
 * and `SeedId`: they start as samples of the first step, and the map of each interval takes all of
 * them together to the next step. vtkTemporalPathLineFilter then makes their paths. A time requires
 * all steps before it, once; 24 bytes a particle are kept for each. The density is that of these
 * particles, at the steps, too.
 *
 * Steps may differ in their grids, but not in axes, planes and direction matrices. Between them the
 * output is on the smallest box that contains both, at the finer spacing. If one of two steps has
 * no mass, that of the other one stays where it is and fades or grows; with TrackParticles it is an
 * error. Repeated times count once. An input with one step, or without steps, comes out as it is,
 * at all times.
 *
 * Data before this filter are requested only within its own requests, so that no interval is made
 * ahead.
 *
 * Cost: a map for each new interval, and O(particles + cells) for each new time. The last two
 * intervals are kept. Memory: about 140 bytes a particle for each.
 *
 * On several ranks each one gets the extent of the image that it requests and the particles at the
 * positions that it owns; each has the whole density of the steps.
 *
 * @sa vtkTransportInterpolator vtkTemporalInterpolator vtkTemporalPathLineFilter
 */
#ifndef vtkTransportTemporalInterpolator_h
#define vtkTransportTemporalInterpolator_h

#include "vtkDensityAlgorithm.h"
#include "vtkImageData.h"
#include "vtkPolyData.h"
#include "vtkRectifiedTransportDensitiesModule.h" // for the export macro

#include <memory> // for std::unique_ptr

namespace RectifiedTransport
{
namespace Bridge
{
struct TemporalInput;
struct TemporalSettings;
struct TemporalStep;
} // namespace Bridge
} // namespace RectifiedTransport

VTK_ABI_NAMESPACE_BEGIN
class VTKRECTIFIEDTRANSPORTDENSITIES_EXPORT vtkTransportTemporalInterpolator
  : public vtkDensityAlgorithm
{
public:
  static vtkTransportTemporalInterpolator* New();
  vtkTypeMacro(vtkTransportTemporalInterpolator, vtkDensityAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * What moves the mass. Optimal (default): the map of least mean squared distance; where it does
   * not reach a density, which is too thin for its grid, the flow takes its place, and a warning
   * says so. RectifiedFlow: the flow of the first density back to the uniform measure and that of
   * the second one from there.
   */
  vtkSetMacro(Method, int);
  vtkGetMacro(Method, int);
  void SetMethodToOptimal() { this->SetMethod(OPTIMAL); }
  void SetMethodToRectifiedFlow() { this->SetMethod(RECTIFIED_FLOW); }
  const char* GetMethodAsString();
  ///@}

  ///@{
  /**
   * 0 (default): any time between the first and the last step may be requested, as TIME_RANGE says.
   * Else TIME_STEPS of so many equal parts of each interval are announced as well, up to 1000000
   * parts and 10000000 steps.
   */
  vtkSetMacro(ResampleFactor, int);
  vtkGetMacro(ResampleFactor, int);
  ///@}

  ///@{
  /**
   * Whether particles keep their identity through all intervals. Off by default.
   */
  vtkSetMacro(TrackParticles, vtkTypeBool);
  vtkGetMacro(TrackParticles, vtkTypeBool);
  vtkBooleanMacro(TrackParticles, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether the other arrays of images, of cells and points, come out, too. Between two steps a
   * floating-point value is the mean, by mass, of those that the particles around it bring along;
   * each of them is linear in time from one end of the particle's way to the other. Where there is
   * no mass, it is linear in time at its place. Integers, bits and texts are labels: each value is
   * that of one of the steps, the one that has most of the mass there, or without mass that of the
   * nearer step at the place. On by default.
   */
  vtkSetMacro(AdvectArrays, vtkTypeBool);
  vtkGetMacro(AdvectArrays, vtkTypeBool);
  vtkBooleanMacro(AdvectArrays, vtkTypeBool);
  ///@}

  ///@{
  /**
   * The number of particles in each cell of a step, at least 1 (default). If it is 4, 9 ... in 2D
   * or 8, 27 ... in 3D, they are the centres of a finer grid, else a fixed low-discrepancy set.
   */
  vtkSetMacro(ParticlesPerCell, int);
  vtkGetMacro(ParticlesPerCell, int);
  ///@}

  ///@{
  /**
   * How the mass of a particle is spread over the image's cells (or dual cells) around it, as in
   * vtkTransportBlend. CloudInCell by default. TriangularShapedCloud is smoother where mass
   * spreads.
   */
  vtkSetMacro(Kernel, int);
  vtkGetMacro(Kernel, int);
  void SetKernelToCloudInCell() { this->SetKernel(CLOUD_IN_CELL); }
  void SetKernelToNearestCell() { this->SetKernel(NEAREST_CELL); }
  void SetKernelToTriangularShapedCloud() { this->SetKernel(TRIANGULAR_SHAPED_CLOUD); }
  void SetKernelToGaussian() { this->SetKernel(GAUSSIAN); }
  const char* GetKernelAsString();
  ///@}

  ///@{
  /**
   * The standard deviation of the Gaussian, in cells, above 0 and at most 10000. Default 1.
   */
  vtkSetMacro(Radius, double);
  vtkGetMacro(Radius, double);
  ///@}

  /**
   * How many maps have been made since the filter was made. An interval that is kept is not made
   * again.
   */
  vtkIdType GetNumberOfMaps();

  /**
   * The interpolated density, output port 0.
   */
  vtkImageData* GetDensity() { return vtkImageData::SafeDownCast(this->GetOutputDataObject(0)); }

  /**
   * The particles, output port 1.
   */
  vtkPolyData* GetParticles() { return vtkPolyData::SafeDownCast(this->GetOutputDataObject(1)); }

protected:
  vtkTransportTemporalInterpolator();
  ~vtkTransportTemporalInterpolator() override;

  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestUpdateTime(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  void EndPasses() override;

  int Method = OPTIMAL;
  int ResampleFactor = 0;
  vtkTypeBool TrackParticles = false;
  vtkTypeBool AdvectArrays = true;
  int ParticlesPerCell = 1;
  int Kernel = CLOUD_IN_CELL;
  double Radius = 1.0;

private:
  struct vtkInternals;

  RectifiedTransport::Bridge::TemporalSettings GetSettings();
  void RunPass(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector);
  int MissingStep(double time);
  void RequestStep(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector);
  bool ReadStep(int step, RectifiedTransport::Progress& progress,
    RectifiedTransport::Bridge::TemporalStep& read);
  bool ExtendTracks(int last, RectifiedTransport::Progress& progress);
  void Interpolate(
    double time, RectifiedTransport::Progress& progress, vtkInformationVector* outputVector);

  std::unique_ptr<vtkInternals> Internals;

  vtkTransportTemporalInterpolator(const vtkTransportTemporalInterpolator&) = delete;
  void operator=(const vtkTransportTemporalInterpolator&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSurfaceSampler
 * @brief   sample a surface with particles
 *
 * Places particles on a surface that is a disk so that each region holds as many as its share of
 * the area, or of the mass of a density per area. Seeds of an even pattern fill the rectangle that
 * the surface is mapped to conformally, which keeps angles and so the pattern; they are moved along
 * the rectified flow of Do, Coeurjolly, Memari and Bonneel, "Linear-Time Transport with Rectified
 * Flows", ACM Transactions on Graphics 44(4), 2025, doi:10.1145/3731147, to the density of the
 * surface in the rectangle, and from there put on its triangles.
 *
 * Input: a vtkPolyData, or a vtkUnstructuredGrid or vtkStructuredGrid of polygons, whose polygons
 * and triangle strips are a disk: one component with one boundary, without holes and handles.
 * Others are errors that say which: clip a closed surface open. Polygons are cut into triangles.
 * Where the surface is no disk otherwise, points that are in no polygon and triangles without area
 * are left out, and points at one place merged, with a warning that counts them; a cut along which
 * points are there twice stays a cut. Lines and vertices do not count. No points give an empty
 * output.
 *
 * The density is array 0 of SetInputArrayToProcess, a point or cell array of one component and any
 * numeric type; none (the default) is 1. The mass of a triangle is its area times the mean of the
 * values at its points (of linear interpolation the exact mass), or times the value of its cell.
 * Negative, NaN and infinite values, and a total mass of zero or past the largest double, are
 * errors. Ghost cells (duplicate, hidden or refined) have no mass.
 *
 * The output is a vtkPolyData with one vertex a particle, in the order of the seeds, and
 * - point data `SeedId` (the particle's number), `Mass` (an equal share of the total mass each),
 *   `CellId` (the cell of the input that it is on), `Normal` (that of its triangle, of length 1,
 *   active normals; on the side from which most of the area is seen to turn left), and the input's
 *   point arrays, interpolated linearly in its triangle (integers are rounded, text is that of the
 *   nearest point), and cell arrays; not those of the names above, no ghost arrays, and no ids of
 *   points (vtkIdTypeArray), which VTK does not interpolate;
 * - field data `TotalMass` (density times area, summed), beside the input's own.
 *
 * A cell of the grid in the rectangle spreads its mass evenly: where it is in triangles with and
 * without mass, particles that would be on the latter are moved to the nearest place that has mass.
 * With 24 bands of density 0 and 1 across a head 3.4 % of the particles were; more Resolution makes
 * them fewer. Where the map turns triangles over, which is rare, their particles are on those
 * above them.
 *
 * Cost: O(points^1.5) for the conformal map, O(points log points + Resolution^2 + particles *
 * steps) for the rest. Memory: up to 1350 bytes a point, 45 a cell of the grid, and 140 a particle
 * and the arrays that are passed.
 *
 * The output is in one piece: where several are requested, piece 0 holds all particles. On
 * several ranks of MPI the surface is gathered on the first one, which has the output.
 *
 * @warning The flow stretches the pattern where the conformal map is very uneven, as on a neck that
 * the map wraps around a head. Where it squeezes much of the surface into few cells of the grid, as
 * the far end of a long tube, the numbers of particles would be wrong: the area-preserving map (see
 * vtkAreaPreservingParameterization) is used instead, with a warning.
 *
 * \code{.cpp}
 * vtkNew<vtkSurfaceSampler> sampler;
 * sampler->SetInputConnection(reader->GetOutputPort());
 * sampler->SetNumberOfParticles(20000);
 * sampler->Update();
 * vtkPolyData* particles = sampler->GetOutput();
 * \endcode
 *
 * @sa vtkTransportSampler vtkAreaPreservingParameterization
 */
#ifndef vtkSurfaceSampler_h
#define vtkSurfaceSampler_h

#include "vtkGuardedAlgorithm.h"

#include <memory> // for std::unique_ptr

namespace RectifiedTransport
{
struct CornerSettings;
class SurfaceDensity;
} // namespace RectifiedTransport

VTK_ABI_NAMESPACE_BEGIN
class vtkPolyData;

class VTKRECTIFIEDTRANSPORT_EXPORT vtkSurfaceSampler : public vtkGuardedAlgorithm
{
public:
  static vtkSurfaceSampler* New();
  vtkTypeMacro(vtkSurfaceSampler, vtkGuardedAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * What SeedPattern may be.
   */
  enum SeedPatternType
  {
    BLUE_NOISE = 0,
    LATTICE = 1,
    JITTERED = 2,
    LOW_DISCREPANCY = 3,
    RANDOM = 4
  };

  /**
   * What Integrator may be.
   */
  enum IntegratorType
  {
    MULTISTEP = 0,
    RUNGE_KUTTA_4 = 1,
    EULER = 2,
    ADAPTIVE = 3
  };

  /**
   * What FlowMaps may be.
   */
  enum FlowMapsType
  {
    FLOW_MAPS_AUTO = 0,
    FLOW_MAPS_ON = 1,
    FLOW_MAPS_OFF = 2
  };

  /**
   * What TableLookup may be.
   */
  enum TableLookupType
  {
    INTERPOLATED = 0,
    NEAREST = 1
  };

  ///@{
  /**
   * The number of particles, at least 1. Default 8192. The output has exactly as many, except where
   * SeedPattern is Lattice.
   */
  vtkSetMacro(NumberOfParticles, vtkIdType);
  vtkGetMacro(NumberOfParticles, vtkIdType);
  ///@}

  ///@{
  /**
   * The number of cells along the longer side of the rectangle that the surface is mapped to, 1 to
   * 16384; along the other one as many as make them nearest to squares. Default 1024.
   */
  vtkSetMacro(Resolution, int);
  vtkGetMacro(Resolution, int);
  ///@}

  ///@{
  /**
   * How the uniform seeds that particles start from are distributed, evenly in lengths.
   * BlueNoise (default): even and irregular, without preferred directions. Lattice: the centres of
   * a grid of equal boxes, whose number is as near to NumberOfParticles as the aspect ratio allows.
   * Jittered: one at random in each of as many boxes of equal measure. LowDiscrepancy: an additive
   * recurrence. Random: independent.
   */
  vtkSetMacro(SeedPattern, int);
  vtkGetMacro(SeedPattern, int);
  void SetSeedPatternToBlueNoise() { this->SetSeedPattern(BLUE_NOISE); }
  void SetSeedPatternToLattice() { this->SetSeedPattern(LATTICE); }
  void SetSeedPatternToJittered() { this->SetSeedPattern(JITTERED); }
  void SetSeedPatternToLowDiscrepancy() { this->SetSeedPattern(LOW_DISCREPANCY); }
  void SetSeedPatternToRandom() { this->SetSeedPattern(RANDOM); }
  const char* GetSeedPatternAsString();
  ///@}

  ///@{
  /**
   * The seed of the random numbers of BlueNoise, Jittered, LowDiscrepancy and Random: any integer;
   * the same one gives the same seeds on every machine. Default 1.
   */
  vtkSetMacro(RandomSeed, int);
  vtkGetMacro(RandomSeed, int);
  ///@}

  ///@{
  /**
   * The points of the surface's boundary that become the corners of the unit square: four point
   * ids, of which the first goes to (0,0) and the others, in the order of the boundary, to (1,0),
   * (1,1) and (0,1). Without any (default) they are chosen. 1000000 at most.
   */
  void SetNumberOfCorners(int count);
  int GetNumberOfCorners();
  void ClearCorners() { this->SetNumberOfCorners(0); }
  ///@}

  ///@{
  /**
   * One of them. The list becomes as long as needed, with -1 for corners that are not set.
   */
  void SetCorner(int index, vtkIdType point);
  vtkIdType GetCorner(int index);
  ///@}

  ///@{
  /**
   * How the velocity field of the flow (equation 12) is integrated. Multistep (default): a graded
   * Adams-Bashforth-Moulton method of order 3, one velocity a step. RungeKutta4 (the paper's
   * Algorithm 2, with the correct limit of the velocity at t = 1) and Euler: uniform steps.
   * Adaptive: individual steps of each particle, controlled by Tolerance.
   */
  vtkSetMacro(Integrator, int);
  vtkGetMacro(Integrator, int);
  void SetIntegratorToMultistep() { this->SetIntegrator(MULTISTEP); }
  void SetIntegratorToRungeKutta4() { this->SetIntegrator(RUNGE_KUTTA_4); }
  void SetIntegratorToEuler() { this->SetIntegrator(EULER); }
  void SetIntegratorToAdaptive() { this->SetIntegrator(ADAPTIVE); }
  const char* GetIntegratorAsString();
  ///@}

  ///@{
  /**
   * The number of steps of Multistep, RungeKutta4 and Euler, 1 to 10000. The default, 32, keeps the
   * mean error of Multistep below a quarter of a cell up to about 1024 cells an axis in 2D and 256
   * in 3D; at a fixed number the error in cells grows with the grid, so use 48 for 512^3 and 64 for
   * 1024^3 and 4096^2.
   */
  vtkSetMacro(NumberOfSteps, int);
  vtkGetMacro(NumberOfSteps, int);
  ///@}

  ///@{
  /**
   * The error that Adaptive allows, in cells of the rectangle's grid, above 0. Default 0.01.
   */
  vtkSetMacro(Tolerance, double);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * What the flow reads of a box. Interpolated (default) integrates the density exactly over every
   * box (the paper's Algorithm 1). Nearest rounds boxes to whole cells (its Figure 4): coarser, for
   * comparisons.
   */
  vtkSetMacro(TableLookup, int);
  vtkGetMacro(TableLookup, int);
  void SetTableLookupToInterpolated() { this->SetTableLookup(INTERPOLATED); }
  void SetTableLookupToNearest() { this->SetTableLookup(NEAREST); }
  const char* GetTableLookupAsString();
  ///@}

  ///@{
  /**
   * Whether lattices of seeds carry the smooth part of the flow, and particles take over by
   * interpolation for the last few steps. Auto (default): where that saves time, decided from the
   * size of the density, NumberOfSteps and the number of particles alone (never for site cells).
   * On, Off. Only Multistep with Interpolated in 2D and 3D uses them, and not with small densities:
   * below about 126 cells a side in 2D and 77 in 3D with 32 steps, with more steps the sooner.
   */
  vtkSetMacro(FlowMaps, int);
  vtkGetMacro(FlowMaps, int);
  void SetFlowMapsToAuto() { this->SetFlowMaps(FLOW_MAPS_AUTO); }
  void SetFlowMapsToOn() { this->SetFlowMaps(FLOW_MAPS_ON); }
  void SetFlowMapsToOff() { this->SetFlowMaps(FLOW_MAPS_OFF); }
  const char* GetFlowMapsAsString();
  ///@}

  /**
   * The particles.
   */
  vtkPolyData* GetOutput();

protected:
  vtkSurfaceSampler();
  ~vtkSurfaceSampler() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  vtkIdType NumberOfParticles;
  int Resolution;
  int SeedPattern;
  int RandomSeed;
  int Integrator;
  int NumberOfSteps;
  double Tolerance;
  int TableLookup;
  int FlowMaps;

private:
  RectifiedTransport::SurfaceDensity FindDensity(vtkPolyData* surface);

  std::unique_ptr<RectifiedTransport::CornerSettings> Corners;

  vtkSurfaceSampler(const vtkSurfaceSampler&) = delete;
  void operator=(const vtkSurfaceSampler&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif

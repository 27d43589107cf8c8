// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSurfaceSampler
 * @brief   sample a surface with particles
 *
 * Places particles on a surface. Each region gets its share of the particles by its area or by the
 * mass of a density per area.
 *
 * Method Relaxation takes triangles of any shape: closed, with holes and handles, in several parts,
 * with edges of three triangles and more, with parts that cross. It draws samples in proportion to
 * the mass, divides them by planes into as many equal parts as there are particles, and puts a
 * particle in each. Particles then repel each other for some iterations. Each step follows the
 * triangles: it turns at their edges, slides along the boundary, and ends where the density jumps.
 *
 * Method Flow takes disks: one component with one boundary, without holes and handles. The surface
 * is mapped conformally to a rectangle; this keeps angles and so the pattern of the seeds. Even
 * seeds fill the rectangle. They move to the density of the surface there along the rectified flow
 * of Do, Coeurjolly, Memari and Bonneel, "Linear-Time Transport with Rectified Flows", ACM
 * Transactions on Graphics 44(4), 2025, doi:10.1145/3731147. Then they are put on the triangles.
 *
 * Input: a vtkPolyData with polygons or triangle strips, a vtkUnstructuredGrid or a
 * vtkStructuredGrid; cells of three dimensions give their outer surface. Polygons are cut into
 * triangles. Lines and vertices are ignored. With Flow, surfaces that are no disk are errors that
 * say what is wrong; points in no polygon and triangles without area are left out, and points at
 * the same position are merged, with a warning that counts them. A cut whose points are duplicated
 * stays a cut. Relaxation joins triangles whose corners are at the same positions. Both close
 * T-junctions (points of other triangles within a side) and leave out triangles that are there
 * before, with a warning that counts them; CellId and the arrays are those of the input's cells. An
 * input without points gives an empty output.
 *
 * The density is array 0 of SetInputArrayToProcess, a point or cell array of one component and any
 * numeric type. Without an array (the default) it is 1. The mass of a triangle is its area times
 * the mean of the values at its points (exact for linear interpolation), or times the value of its
 * cell. Negative, NaN and infinite values, and a total mass of zero or beyond the largest double,
 * are errors. Ghost cells (duplicate, hidden or refined) have no mass.
 *
 * The output is a vtkPolyData with one vertex a particle, near ones one after the other, or with
 * Flow in the order of the seeds, and
 * - point data `SeedId` (the particle's number), `Mass` (equal shares of the total mass), `CellId`
 *   (the cell of the input that it is on), and `Normal` (the unit normal of its triangle, active
 *   normals; on the side from which the polygon appears counterclockwise, with Flow most of the
 *   area). The input's point
 *   arrays are interpolated linearly in the triangle; integers are rounded, text is that of the
 *   nearest point. Its cell arrays have the cell's value. Arrays with the names above, ghost arrays
 *   and ids of points (vtkIdTypeArray), which VTK does not interpolate, are left out;
 * - field data `TotalMass` (density times area, summed), the input's field data, and with Flow
 *   `MovedParticles` (those that ended in an empty cell of the grid and were put on the nearest
 *   mass; a warning counts them if they are at least one in a thousand).
 *
 * With Flow, a cell of the grid in the rectangle spreads its mass evenly. If it overlaps triangles
 * with mass and without, particles on the latter are moved to the nearest place that has mass. With
 * 24 bands of density 0 and 1 across a head, 3.4 % of the particles were moved; a higher Resolution
 * lowers this number. In rare cases the map turns triangles over. Their particles are then on the
 * triangles above them.
 *
 * Cost of Relaxation: O(triangles + particles * RelaxationIterations). Cost of Flow: O(points^1.5)
 * for the conformal map, O(points log points + Resolution^2 + particles * steps) for the rest.
 * Memory: up to 1350 bytes a point, 45 a cell of the grid, and 140 a particle, plus the arrays that
 * are passed.
 *
 * The output is in one piece: if several are requested, piece 0 holds all particles. With several
 * MPI ranks the surface is gathered on rank 0, which has the output.
 *
 * @warning Method Flow stretches the pattern where the conformal map is very uneven, for example on
 * the neck of a head. If the map squeezes much of the surface into few cells of the grid, for
 * example the far end of a long tube, the numbers of particles would be wrong. The area-preserving
 * map (see vtkAreaPreservingParameterization) is then used instead, with a warning.
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

#include "vtkDiskAlgorithm.h"
#include "vtkRectifiedTransportMeshesModule.h" // for the export macro

VTK_ABI_NAMESPACE_BEGIN
class VTKRECTIFIEDTRANSPORTMESHES_EXPORT vtkSurfaceSampler : public vtkDiskAlgorithm
{
public:
  static vtkSurfaceSampler* New();
  vtkTypeMacro(vtkSurfaceSampler, vtkDiskAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * What Method may be.
   */
  enum MethodType
  {
    RELAXATION = 0,
    FLOW = 1
  };

  ///@{
  /**
   * The number of particles, at least 1. Default 8192. It is exact unless Method is Flow and
   * SeedPattern is Lattice.
   */
  vtkSetMacro(NumberOfParticles, vtkIdType);
  vtkGetMacro(NumberOfParticles, vtkIdType);
  ///@}

  ///@{
  /**
   * How particles are placed. Relaxation (default): on any surface, evenly, by repulsion. Flow: on
   * disks, by the rectified flow in a conformal map. Corners, Resolution, SeedPattern and what
   * follows them are of Flow alone.
   */
  vtkSetMacro(Method, int);
  vtkGetMacro(Method, int);
  void SetMethodToRelaxation() { this->SetMethod(RELAXATION); }
  void SetMethodToFlow() { this->SetMethod(FLOW); }
  const char* GetMethodAsString();
  ///@}

  ///@{
  /**
   * The number of iterations of Relaxation, 0 to 1000. More make distances of particles more equal.
   * Default 20.
   */
  vtkSetMacro(RelaxationIterations, int);
  vtkGetMacro(RelaxationIterations, int);
  ///@}

  ///@{
  /**
   * The number of cells along the longer side of the rectangle that the surface is mapped to, 1 to
   * 16384. Default 1024. The number along the other side makes the cells as near to squares as
   * possible.
   */
  vtkSetMacro(Resolution, int);
  vtkGetMacro(Resolution, int);
  ///@}

  ///@{
  /**
   * The distribution of the uniform seeds that particles start from, even in physical lengths.
   * BlueNoise (default): even and irregular, without preferred directions. Lattice: the centres of
   * a grid of equal boxes, as near to NumberOfParticles as the aspect ratio allows. Jittered: one
   * random point in each of as many boxes of equal measure. LowDiscrepancy: an additive recurrence.
   * Random: independent.
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
   * The seed of the random numbers of BlueNoise, Jittered, LowDiscrepancy and Random: any integer.
   * The same number gives the same seeds on every machine. Default 1.
   */
  vtkSetMacro(RandomSeed, int);
  vtkGetMacro(RandomSeed, int);
  ///@}

  ///@{
  /**
   * How the velocity field of the flow (equation 12) is integrated. Multistep (default): a graded
   * Adams-Bashforth-Moulton method of order 3, with one velocity a step. RungeKutta4 (the paper's
   * Algorithm 2, with the correct limit of the velocity at t = 1) and Euler: uniform steps.
   * Adaptive: individual steps for each particle, controlled by Tolerance.
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
   * The number of steps of Multistep, RungeKutta4 and Euler, 1 to 10000. 0 (default): as many as
   * AreaTolerance asks, 32 to 4096, by the density, the direction and the number of particles.
   */
  vtkSetMacro(NumberOfSteps, int);
  vtkGetMacro(NumberOfSteps, int);
  ///@}

  ///@{
  /**
   * Where NumberOfSteps is 0: the largest error of the masses, or backward of the areas (volumes),
   * of 99.9 % of blocks, relative to their mass or 5 % of the mean block's; above 0 and at most 1.
   * Blocks have 4 cells a side; where particles show the density, they hold AreaTolerance^(-4/3)
   * of them or more. With the default, 0.02, a run costs at most 8 times as much as with 32 steps;
   * other values have no limit. A warning says what is reached, and what would be needed.
   */
  vtkSetMacro(AreaTolerance, double);
  vtkGetMacro(AreaTolerance, double);
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
   * How the density is integrated over a box. Interpolated (default): exactly (the paper's
   * Algorithm 1). Nearest: boxes are rounded to whole cells (its Figure 4); coarser, for
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
   * Whether lattices of seeds carry the smooth part of the flow. Particles are then interpolated
   * from them and take only the last few steps themselves. Auto (default): if that saves time,
   * which depends only on the size of the density, NumberOfSteps and the number of particles. On,
   * Off. Only Multistep with Interpolated uses flow maps, and not for small grids: with 32 steps,
   * those below about 126 cells a side. More steps lower this limit.
   */
  vtkSetMacro(FlowMaps, int);
  vtkGetMacro(FlowMaps, int);
  void SetFlowMapsToAuto() { this->SetFlowMaps(FLOW_MAPS_AUTO); }
  void SetFlowMapsToOn() { this->SetFlowMaps(FLOW_MAPS_ON); }
  void SetFlowMapsToOff() { this->SetFlowMaps(FLOW_MAPS_OFF); }
  const char* GetFlowMapsAsString();
  ///@}

protected:
  vtkSurfaceSampler();
  ~vtkSurfaceSampler() override = default;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  vtkIdType NumberOfParticles = 8192;
  int Method = RELAXATION;
  int RelaxationIterations = 20;
  int Resolution = 1024;
  int SeedPattern = BLUE_NOISE;
  int RandomSeed = 1;
  int Integrator = MULTISTEP;
  int NumberOfSteps = 0;
  double AreaTolerance = 0.02;
  double Tolerance = 0.01;
  int TableLookup = INTERPOLATED;
  int FlowMaps = FLOW_MAPS_AUTO;

private:
  vtkSurfaceSampler(const vtkSurfaceSampler&) = delete;
  void operator=(const vtkSurfaceSampler&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file    vtkTransportProperties.h
 * @brief   properties that classes without a common superclass have, each declared once
 *
 * A class with these properties uses the macro in its declaration, and the macro vtkImplement... of
 * the same name in its source file.
 */
#ifndef vtkTransportProperties_h
#define vtkTransportProperties_h

#include "vtkSetGet.h"
#include "vtkType.h"

#include <memory> // for std::unique_ptr

namespace RectifiedTransport
{
struct AssociationSettings;
struct CornerSettings;
struct FlowSettings;
struct SeedSettings;
struct SplatSettings;
struct TableSettings;
} // namespace RectifiedTransport

/**
 * What a flow keeps of a density:
 *
 * - Tables. Whole: summed-area tables of the whole grid, 32 bytes a cell, until the density changes.
 *   Tiled: tables of few nodes, and those of tiles, which are made in each run and worked through
 *   one after another: an eighth of the memory at 512^3 cells, in about the same time, as exact but
 *   of other bits. It takes Multistep with Interpolated in 2D and 3D, NumberOfSteps of
 *   about 8 or more, and gives positions at the end of the flow alone; else it is an error. Auto
 *   (default): Tiled for densities of more than 2^26 cells where it serves, else Whole.
 */
#define vtkTablesPropertiesMacro()                                                                   \
public:                                                                                            \
  enum TablesType                                                                                  \
  {                                                                                                \
    TABLES_AUTO = 0,                                                                               \
    TABLES_WHOLE = 1,                                                                              \
    TABLES_TILED = 2                                                                               \
  };                                                                                               \
  vtkSetMacro(Tables, int);                                                                        \
  vtkGetMacro(Tables, int);                                                                        \
  void SetTablesToAuto()                                                                           \
  {                                                                                                \
    this->SetTables(TABLES_AUTO);                                                                  \
  }                                                                                                \
  void SetTablesToWhole()                                                                          \
  {                                                                                                \
    this->SetTables(TABLES_WHOLE);                                                                 \
  }                                                                                                \
  void SetTablesToTiled()                                                                          \
  {                                                                                                \
    this->SetTables(TABLES_TILED);                                                                 \
  }                                                                                                \
  const char* GetTablesAsString();                                                                 \
                                                                                                   \
protected:                                                                                         \
  /** The property as the bridge takes it. */                                                      \
  RectifiedTransport::TableSettings GetTableSettings();                                            \
                                                                                                   \
  int Tables = TABLES_AUTO

/**
 * How the velocity field of a flow (equation 12) is integrated:
 *
 * - Integrator. Multistep (default): a graded Adams-Bashforth-Moulton method of order 3, one
 *   velocity a step. RungeKutta4 (the paper's Algorithm 2, with the correct limit of the velocity
 *   at t = 1) and Euler: uniform steps. Adaptive: individual steps of each particle, controlled by
 *   Tolerance.
 * - NumberOfSteps: that of Multistep, RungeKutta4 and Euler, 1 to 10000. The default, 32, keeps the
 *   mean error of Multistep below a quarter of a cell up to about 1024 cells an axis in 2D and 256
 *   in 3D; at a fixed number the error in cells grows with the grid, so use 48 for 512^3 and 64 for
 *   1024^3 and 4096^2.
 * - Tolerance: the error that Adaptive allows, in cells of the density, above 0. Default 0.01.
 * - TableLookup. Interpolated (default) integrates the density exactly over every box (the paper's
 *   Algorithm 1). Nearest rounds boxes to whole cells (its Figure 4): coarser, for comparisons.
 * - FlowMaps: lattices of seeds carry the smooth part of the flow, and particles take over by
 *   interpolation for the last few steps. Auto (default): where that saves time, decided from the
 *   size of the density, NumberOfSteps and the number of particles alone (never for site cells).
 *   On, Off. Only Multistep with Interpolated in 2D and 3D uses them, and not with small densities:
 *   below about 126 cells a side in 2D and 77 in 3D with 32 steps, with more steps the sooner.
 */
#define vtkFlowPropertiesMacro()                                                                   \
public:                                                                                            \
  enum IntegratorType                                                                              \
  {                                                                                                \
    MULTISTEP = 0,                                                                                 \
    RUNGE_KUTTA_4 = 1,                                                                             \
    EULER = 2,                                                                                     \
    ADAPTIVE = 3                                                                                   \
  };                                                                                               \
  enum FlowMapsType                                                                                \
  {                                                                                                \
    FLOW_MAPS_AUTO = 0,                                                                            \
    FLOW_MAPS_ON = 1,                                                                              \
    FLOW_MAPS_OFF = 2                                                                              \
  };                                                                                               \
  enum TableLookupType                                                                             \
  {                                                                                                \
    INTERPOLATED = 0,                                                                              \
    NEAREST = 1                                                                                    \
  };                                                                                               \
  vtkSetMacro(Integrator, int);                                                                    \
  vtkGetMacro(Integrator, int);                                                                    \
  void SetIntegratorToMultistep()                                                                  \
  {                                                                                                \
    this->SetIntegrator(MULTISTEP);                                                                \
  }                                                                                                \
  void SetIntegratorToRungeKutta4()                                                                \
  {                                                                                                \
    this->SetIntegrator(RUNGE_KUTTA_4);                                                            \
  }                                                                                                \
  void SetIntegratorToEuler()                                                                      \
  {                                                                                                \
    this->SetIntegrator(EULER);                                                                    \
  }                                                                                                \
  void SetIntegratorToAdaptive()                                                                   \
  {                                                                                                \
    this->SetIntegrator(ADAPTIVE);                                                                 \
  }                                                                                                \
  const char* GetIntegratorAsString();                                                             \
  vtkSetMacro(NumberOfSteps, int);                                                                 \
  vtkGetMacro(NumberOfSteps, int);                                                                 \
  vtkSetMacro(Tolerance, double);                                                                  \
  vtkGetMacro(Tolerance, double);                                                                  \
  vtkSetMacro(TableLookup, int);                                                                   \
  vtkGetMacro(TableLookup, int);                                                                   \
  void SetTableLookupToInterpolated()                                                              \
  {                                                                                                \
    this->SetTableLookup(INTERPOLATED);                                                            \
  }                                                                                                \
  void SetTableLookupToNearest()                                                                   \
  {                                                                                                \
    this->SetTableLookup(NEAREST);                                                                 \
  }                                                                                                \
  const char* GetTableLookupAsString();                                                            \
  vtkSetMacro(FlowMaps, int);                                                                      \
  vtkGetMacro(FlowMaps, int);                                                                      \
  void SetFlowMapsToAuto()                                                                         \
  {                                                                                                \
    this->SetFlowMaps(FLOW_MAPS_AUTO);                                                             \
  }                                                                                                \
  void SetFlowMapsToOn()                                                                           \
  {                                                                                                \
    this->SetFlowMaps(FLOW_MAPS_ON);                                                               \
  }                                                                                                \
  void SetFlowMapsToOff()                                                                          \
  {                                                                                                \
    this->SetFlowMaps(FLOW_MAPS_OFF);                                                              \
  }                                                                                                \
  const char* GetFlowMapsAsString();                                                               \
                                                                                                   \
protected:                                                                                         \
  RectifiedTransport::FlowSettings GetFlowSettings();                                              \
  int Integrator = MULTISTEP;                                                                      \
  int NumberOfSteps = 32;                                                                          \
  double Tolerance = 0.01;                                                                         \
  int TableLookup = INTERPOLATED;                                                                  \
  int FlowMaps = FLOW_MAPS_AUTO

/**
 * The uniform seeds that particles start from:
 *
 * - SeedPattern: how the seeds are distributed, evenly in lengths. BlueNoise (default): even and
 *   irregular, without preferred directions. Lattice: the centres of a grid of equal boxes, whose
 *   number is as near to NumberOfParticles as the aspect ratio allows. Jittered: one at random in
 *   each of as many boxes of equal measure. LowDiscrepancy: an additive recurrence. Random:
 *   independent.
 * - RandomSeed: the seed of the random numbers of BlueNoise, Jittered, LowDiscrepancy and Random:
 *   any integer; the same one gives the same seeds on every machine. Default 1.
 */
#define vtkSeedPropertiesMacro()                                                                   \
public:                                                                                            \
  enum SeedPatternType                                                                             \
  {                                                                                                \
    BLUE_NOISE = 0,                                                                                \
    LATTICE = 1,                                                                                   \
    JITTERED = 2,                                                                                  \
    LOW_DISCREPANCY = 3,                                                                           \
    RANDOM = 4                                                                                     \
  };                                                                                               \
  vtkSetMacro(SeedPattern, int);                                                                   \
  vtkGetMacro(SeedPattern, int);                                                                   \
  void SetSeedPatternToBlueNoise()                                                                 \
  {                                                                                                \
    this->SetSeedPattern(BLUE_NOISE);                                                              \
  }                                                                                                \
  void SetSeedPatternToLattice()                                                                   \
  {                                                                                                \
    this->SetSeedPattern(LATTICE);                                                                 \
  }                                                                                                \
  void SetSeedPatternToJittered()                                                                  \
  {                                                                                                \
    this->SetSeedPattern(JITTERED);                                                                \
  }                                                                                                \
  void SetSeedPatternToLowDiscrepancy()                                                            \
  {                                                                                                \
    this->SetSeedPattern(LOW_DISCREPANCY);                                                         \
  }                                                                                                \
  void SetSeedPatternToRandom()                                                                    \
  {                                                                                                \
    this->SetSeedPattern(RANDOM);                                                                  \
  }                                                                                                \
  const char* GetSeedPatternAsString();                                                            \
  vtkSetMacro(RandomSeed, int);                                                                    \
  vtkGetMacro(RandomSeed, int);                                                                    \
                                                                                                   \
protected:                                                                                         \
  RectifiedTransport::SeedSettings GetSeedSettings();                                              \
  int SeedPattern = BLUE_NOISE;                                                                    \
  int RandomSeed = 1

/**
 * How the mass of a particle is spread over the image's cells (or dual cells) around it (see
 * RectifiedTransport::SplatKernel):
 *
 * - Kernel. CloudInCell (default): linearly over 2 cells along each axis. NearestCell: into the
 *   cell that contains the point (on a face, the upper one). TriangularShapedCloud: quadratically
 *   over 3 cells. Gaussian: as a Gaussian of the given Radius.
 * - Radius: the standard deviation of the Gaussian, in cells, above 0 and at most 10000. The kernel
 *   is cut at 3 of them, and corrected to first order so that it keeps the centroid; up to a third
 *   of a cell it is the CloudInCell. Default 1.
 */
#define vtkSplatPropertiesMacro()                                                                  \
public:                                                                                            \
  enum KernelType                                                                                  \
  {                                                                                                \
    CLOUD_IN_CELL = 0,                                                                             \
    NEAREST_CELL = 1,                                                                              \
    TRIANGULAR_SHAPED_CLOUD = 2,                                                                   \
    GAUSSIAN = 3                                                                                   \
  };                                                                                               \
  vtkSetMacro(Kernel, int);                                                                        \
  vtkGetMacro(Kernel, int);                                                                        \
  void SetKernelToCloudInCell()                                                                    \
  {                                                                                                \
    this->SetKernel(CLOUD_IN_CELL);                                                                \
  }                                                                                                \
  void SetKernelToNearestCell()                                                                    \
  {                                                                                                \
    this->SetKernel(NEAREST_CELL);                                                                 \
  }                                                                                                \
  void SetKernelToTriangularShapedCloud()                                                          \
  {                                                                                                \
    this->SetKernel(TRIANGULAR_SHAPED_CLOUD);                                                      \
  }                                                                                                \
  void SetKernelToGaussian()                                                                       \
  {                                                                                                \
    this->SetKernel(GAUSSIAN);                                                                     \
  }                                                                                                \
  const char* GetKernelAsString();                                                                 \
  vtkSetMacro(Radius, double);                                                                     \
  vtkGetMacro(Radius, double);                                                                     \
                                                                                                   \
protected:                                                                                         \
  RectifiedTransport::SplatSettings GetSplatSettings();                                            \
  int Kernel = CLOUD_IN_CELL;                                                                      \
  double Radius = 1.0

/**
 * The field association of the values of an output image:
 *
 * - Association. Points (default): point data, on points at the cells' centres (with the geometry
 *   of a reference image: on its points), ready for contours and volume rendering. Cells: cell
 *   data. The numbers are the same.
 */
#define vtkAssociationPropertiesMacro()                                                            \
public:                                                                                            \
  enum AssociationType                                                                             \
  {                                                                                                \
    POINTS = 0,                                                                                    \
    CELLS = 1                                                                                      \
  };                                                                                               \
  vtkSetMacro(Association, int);                                                                   \
  vtkGetMacro(Association, int);                                                                   \
  void SetAssociationToPoints()                                                                    \
  {                                                                                                \
    this->SetAssociation(POINTS);                                                                  \
  }                                                                                                \
  void SetAssociationToCells()                                                                     \
  {                                                                                                \
    this->SetAssociation(CELLS);                                                                   \
  }                                                                                                \
  const char* GetAssociationAsString();                                                            \
                                                                                                   \
protected:                                                                                         \
  RectifiedTransport::AssociationSettings GetAssociationSettings();                                \
  int Association = POINTS

/**
 * The points of a surface's boundary that become the corners of the unit square:
 *
 * - Corners. Four point ids: the first goes to (0,0) and the others, in the order of the boundary,
 *   to (1,0), (1,1) and (0,1). Without any (default: none) they are chosen. SetCorner makes the
 *   list as long as needed, with -1 for corners that are not set; it has 1000000 at most.
 */
#define vtkCornersPropertiesMacro()                                                                \
public:                                                                                            \
  void SetNumberOfCorners(int count);                                                              \
  int GetNumberOfCorners();                                                                        \
  void SetCorner(int index, vtkIdType point);                                                      \
  vtkIdType GetCorner(int index);                                                                  \
  void ClearCorners()                                                                              \
  {                                                                                                \
    this->SetNumberOfCorners(0);                                                                   \
  }                                                                                                \
                                                                                                   \
protected:                                                                                         \
  std::unique_ptr<RectifiedTransport::CornerSettings> Corners

#endif

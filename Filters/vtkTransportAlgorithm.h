// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTransportAlgorithm
 * @brief   what all filters that move points with the rectified flow of a density share
 *
 * The flow is that of Do, Coeurjolly, Memari and Bonneel, "Linear-Time Transport with Rectified
 * Flows", ACM Transactions on Graphics 44(4), 2025, doi:10.1145/3731147: points that are uniform at
 * time 0 follow the velocity field of its equation 12, which needs the mass and the centroid of the
 * density in a box (equations 10 and 11); both come from summed-area tables (Section 3.3).
 *
 * This class holds how the field is integrated, and keeps the tables between runs. They are built
 * anew only when the density changes (its array, ghost arrays, image or the properties of
 * vtkDensityAlgorithm), at a cost of O(cells) in time and of about 21, 34 and 33 bytes a cell in
 * 1D, 2D and 3D in memory.
 *
 * Results are the same to the last bit for every number of threads and every setting of Threading.
 *
 * @sa vtkDensityAlgorithm vtkTransportSampler vtkTransportMap
 */
#ifndef vtkTransportAlgorithm_h
#define vtkTransportAlgorithm_h

#include "vtkDensityAlgorithm.h"

#include <memory> // for std::unique_ptr

namespace RectifiedTransport
{
class Executor;
class FlowCache;
struct FlowOptions;
struct FlowSettings;
} // namespace RectifiedTransport

VTK_ABI_NAMESPACE_BEGIN

class VTKRECTIFIEDTRANSPORT_EXPORT vtkTransportAlgorithm : public vtkDensityAlgorithm
{
public:
  vtkTypeMacro(vtkTransportAlgorithm, vtkDensityAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

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
   * What TableLookup may be.
   */
  enum TableLookupType
  {
    INTERPOLATED = 0,
    NEAREST = 1
  };

  /**
   * What Threading may be.
   */
  enum ThreadingType
  {
    THREADING_AUTO = 0,
    THREADING_VTK = 1,
    THREADING_OPENMP = 2,
    THREADING_SERIAL = 3
  };

  ///@{
  /**
   * How the velocity field (equation 12) is integrated. Multistep (default): a graded
   * Adams-Bashforth-Moulton method of order 3, one velocity a step. RungeKutta4 (the paper's
   * Algorithm 2, with the correct limit of the velocity at the end) and Euler: uniform steps.
   * Adaptive: steps of each particle's own, chosen by Tolerance.
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
   * The error that Adaptive allows, in cells of the density, above 0. Default 0.01.
   */
  vtkSetMacro(Tolerance, double);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * Interpolated (default) integrates the density exactly over every box (the paper's Algorithm 1).
   * Nearest rounds boxes to whole cells (its Figure 4): coarser, for comparisons.
   */
  vtkSetMacro(TableLookup, int);
  vtkGetMacro(TableLookup, int);
  void SetTableLookupToInterpolated() { this->SetTableLookup(INTERPOLATED); }
  void SetTableLookupToNearest() { this->SetTableLookup(NEAREST); }
  const char* GetTableLookupAsString();
  ///@}

  ///@{
  /**
   * Who runs the parallel loops: VTK (vtkSMPTools with the backend in use), OpenMP, or Serial. Auto
   * (default) is OpenMP where VTK's backend is Sequential, else VTK. It changes the time, never the
   * result.
   */
  vtkSetMacro(Threading, int);
  vtkGetMacro(Threading, int);
  void SetThreadingToAuto() { this->SetThreading(THREADING_AUTO); }
  void SetThreadingToVTK() { this->SetThreading(THREADING_VTK); }
  void SetThreadingToOpenMP() { this->SetThreading(THREADING_OPENMP); }
  void SetThreadingToSerial() { this->SetThreading(THREADING_SERIAL); }
  const char* GetThreadingAsString();
  ///@}

  /**
   * When the tables were last built: grows with each build, 0 before the first.
   */
  vtkMTimeType GetTableBuildTime();

protected:
  /**
   * The density is on input port `densityPort`.
   */
  explicit vtkTransportAlgorithm(int densityPort = 0);
  ~vtkTransportAlgorithm() override;

  /**
   * The properties as the core takes them. Throws what RequestData may throw.
   */
  RectifiedTransport::FlowOptions GetFlowOptions();

  /**
   * Who runs the parallel loops; the caller deletes it. Throws what RequestData may throw.
   */
  RectifiedTransport::Executor* NewExecutor();

  /**
   * The flow that is kept between runs.
   */
  RectifiedTransport::FlowCache& GetFlowCache();

  int Integrator;
  int NumberOfSteps;
  double Tolerance;
  int TableLookup;
  int Threading;

private:
  RectifiedTransport::FlowSettings GetFlowSettings();

  struct vtkInternals;
  std::unique_ptr<vtkInternals> Internals;

  vtkTransportAlgorithm(const vtkTransportAlgorithm&) = delete;
  void operator=(const vtkTransportAlgorithm&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif

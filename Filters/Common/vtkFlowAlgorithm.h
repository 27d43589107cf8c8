// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkFlowAlgorithm
 * @brief   superclass of the filters that move points by the rectified flow of a density
 *
 * The flow is that of Do, Coeurjolly, Memari and Bonneel, "Linear-Time Transport with Rectified
 * Flows", ACM Transactions on Graphics 44(4), 2025, doi:10.1145/3731147. Points that are uniform at
 * time 0 follow the velocity field of equation 12. The velocity needs the mass and the centroid of
 * the density in a box (equations 10 and 11). Both come from summed-area tables (Section 3.3).
 *
 * This class holds the properties of the integration.
 *
 * @sa vtkDensityAlgorithm vtkTransportAlgorithm vtkEqualMassCells
 */
#ifndef vtkFlowAlgorithm_h
#define vtkFlowAlgorithm_h

#include "vtkDensityAlgorithm.h"
#include "vtkRectifiedTransportCommonModule.h" // for the export macro

namespace RectifiedTransport
{
struct FlowOptions;
} // namespace RectifiedTransport

VTK_ABI_NAMESPACE_BEGIN
class VTKRECTIFIEDTRANSPORTCOMMON_EXPORT vtkFlowAlgorithm : public vtkDensityAlgorithm
{
public:
  vtkTypeMacro(vtkFlowAlgorithm, vtkDensityAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

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
   * The error that Adaptive allows, in cells of the density, above 0. Default 0.01.
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
   * which depends only on the size of the density, NumberOfSteps and the number of particles; never
   * for site cells. On, Off. Only Multistep with Interpolated in 2D and 3D uses flow maps, and not
   * for small densities: with 32 steps, those below about 126 cells a side in 2D and 77 in 3D. More
   * steps lower this limit.
   */
  vtkSetMacro(FlowMaps, int);
  vtkGetMacro(FlowMaps, int);
  void SetFlowMapsToAuto() { this->SetFlowMaps(FLOW_MAPS_AUTO); }
  void SetFlowMapsToOn() { this->SetFlowMaps(FLOW_MAPS_ON); }
  void SetFlowMapsToOff() { this->SetFlowMaps(FLOW_MAPS_OFF); }
  const char* GetFlowMapsAsString();
  ///@}

protected:
  /**
   * The density is on input port `densityPort`.
   */
  explicit vtkFlowAlgorithm(int densityPort)
    : vtkDensityAlgorithm(densityPort)
  {
  }
  ~vtkFlowAlgorithm() override = default;

  /**
   * The properties of the integration, checked. Throws what RequestData may throw.
   */
  RectifiedTransport::FlowOptions GetFlowOptions();

  int Integrator = MULTISTEP;
  int NumberOfSteps = 0;
  double AreaTolerance = 0.02;
  double Tolerance = 0.01;
  int TableLookup = INTERPOLATED;
  int FlowMaps = FLOW_MAPS_AUTO;

private:
  vtkFlowAlgorithm(const vtkFlowAlgorithm&) = delete;
  void operator=(const vtkFlowAlgorithm&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTransportAlgorithm
 * @brief   superclass of the filters that move points by a map between a density and the uniform
 *          measure
 *
 * The flow is that of Do, Coeurjolly, Memari and Bonneel, "Linear-Time Transport with Rectified
 * Flows", ACM Transactions on Graphics 44(4), 2025, doi:10.1145/3731147. Points that are uniform at
 * time 0 follow the velocity field of equation 12. The velocity needs the mass and the centroid of
 * the density in a box (equations 10 and 11). Both come from summed-area tables (Section 3.3).
 *
 * With Method Optimal the map of least mean squared distance takes the place of the flow (see
 * OptimalMap.h in the core): by the back-and-forth method of Jacobs and Leger, "A fast approach to
 * optimal transport: the back-and-forth method", Numerische Mathematik 146, 2020,
 * doi:10.1007/s00211-020-01154-8. With it, or with Certify, outputs have the field data
 * - `TransportCostLowerBound`: no map between the uniform measure and the density costs less. This
 *   is certified, up to rounding; it is not the distance itself;
 * - `OptimalityGap`: the cost of the map that is delivered over the bound, less one, not below 0.
 * It has the errors of the map's masses and of the samples that the cost is from. Where the bound
 * is 0, it is 0 for a cost of 0 up to rounding, else infinite.
 *
 * This class holds the properties of the method, of the tables, of the integration and of the
 * device.
 *
 * @sa vtkDensityAlgorithm vtkTransportSampler vtkTransportMap
 */
#ifndef vtkTransportAlgorithm_h
#define vtkTransportAlgorithm_h

#include "vtkDensityAlgorithm.h"
#include "vtkRectifiedTransportCommonModule.h" // for the export macro

#include <memory> // for std::unique_ptr
#include <string> // for texts

namespace RectifiedTransport
{
class DeviceUse;
struct FlowOptions;
namespace Bridge
{
struct OptimalSetting;
} // namespace Bridge
} // namespace RectifiedTransport

VTK_ABI_NAMESPACE_BEGIN
class vtkStringArray;

class VTKRECTIFIEDTRANSPORTCOMMON_EXPORT vtkTransportAlgorithm : public vtkDensityAlgorithm
{
public:
  vtkTypeMacro(vtkTransportAlgorithm, vtkDensityAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * What Device may be.
   */
  enum DeviceType
  {
    DEVICE_CPU = 0,
    DEVICE_OPENCL = 1
  };

  ///@{
  /**
   * What moves the points. RectifiedFlow (default): the flow, which is fast and keeps masses, but
   * costs a few per cent more than the optimal map. Optimal: a map whose cost is near the least
   * possible one. The properties of the flow (Integrator, NumberOfSteps, FlowMaps, Device and the
   * like) then have no effect, Tables Tiled is an error, and StepsTaken is 0. The map is kept until
   * the density or OptimalityTolerance changes, and filters that read the same density share it. If
   * the density is too thin for its grid, for example lines of less than three cells, the points
   * are moved by the flow, and a warning says so.
   */
  vtkSetMacro(Method, int);
  vtkGetMacro(Method, int);
  void SetMethodToRectifiedFlow() { this->SetMethod(RECTIFIED_FLOW); }
  void SetMethodToOptimal() { this->SetMethod(OPTIMAL); }
  const char* GetMethodAsString();
  ///@}

  ///@{
  /**
   * With Optimal or Certify: iterations end when one raises the bound of the cost by less than a
   * quarter of this part of it. Above 0 and below 1. Default 0.001.
   */
  vtkSetMacro(OptimalityTolerance, double);
  vtkGetMacro(OptimalityTolerance, double);
  ///@}

  ///@{
  /**
   * With RectifiedFlow: give TransportCostLowerBound, OptimalityGap and, for particles, Slack of
   * the flow's map, too. This solves the optimal map, which takes longer than most flows, and needs
   * whole tables. Optimal always gives them. Off by default.
   */
  vtkSetMacro(Certify, vtkTypeBool);
  vtkGetMacro(Certify, vtkTypeBool);
  vtkBooleanMacro(Certify, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Which tables a flow uses. Whole: summed-area tables of the whole grid, 32 bytes a cell, which
   * are kept until the density changes. Tiled: tables of few nodes and, one after another, tables
   * of tiles, made in each run. Tiled takes an eighth of the memory at 512^3 cells in about the
   * same time. It is as exact but not bitwise equal. It needs Multistep with Interpolated in 2D or
   * 3D and a NumberOfSteps of about 8 or more, and it gives only positions at the end of the flow;
   * anything else is an error. Auto (default): Tiled for densities of more than 2^26 cells if tiles
   * support the other settings, else Whole.
   */
  vtkSetMacro(Tables, int);
  vtkGetMacro(Tables, int);
  void SetTablesToAuto() { this->SetTables(TABLES_AUTO); }
  void SetTablesToWhole() { this->SetTables(TABLES_WHOLE); }
  void SetTablesToTiled() { this->SetTables(TABLES_TILED); }
  const char* GetTablesAsString();
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

  ///@{
  /**
   * Where the flow is computed: CPU (default), or OpenCL: on a device, usually a graphics card,
   * with the same bits. The processor does what a device does not support. If there is no device,
   * or it fails, a warning says why, and the processor does the work, or the rest of it. A device
   * needs double precision and has to pass a test of its arithmetic when it is opened, which takes
   * about a second. It stays open, for all filters of the program, until the last filter that uses
   * it is deleted, or runs with CPU. Devices with slow double precision, as most graphics cards for
   * games, may be slower than a processor of many cores. With several MPI ranks on a machine, each
   * takes the next device.
   */
  vtkSetMacro(Device, int);
  vtkGetMacro(Device, int);
  void SetDeviceToCPU() { this->SetDevice(DEVICE_CPU); }
  void SetDeviceToOpenCL() { this->SetDevice(DEVICE_OPENCL); }
  const char* GetDeviceAsString();
  ///@}

  ///@{
  /**
   * With OpenCL: the name of the device, or a part of it, in any case of letters. If several
   * devices match, the first that can be used is taken. Empty (default): any device.
   */
  void SetDeviceName(const char* name);
  const char* GetDeviceName();
  ///@}

  /**
   * With Device OpenCL: the empty text, and the names of the devices of this machine that have what
   * is needed. With CPU only the empty text: no driver is loaded to find devices that nobody uses.
   */
  vtkStringArray* GetDeviceNames();

protected:
  /**
   * The density is on input port `densityPort`.
   */
  explicit vtkTransportAlgorithm(int densityPort = 0);
  ~vtkTransportAlgorithm() override;

  /**
   * The properties of the integration, checked; so is Device. Throws what RequestData may throw.
   */
  RectifiedTransport::FlowOptions GetFlowOptions();

  /**
   * Method, OptimalityTolerance and Certify, checked. Throws what RequestData may throw.
   */
  RectifiedTransport::Bridge::OptimalSetting GetOptimalSetting();

  /**
   * The device of a run, opened. Collective.
   */
  RectifiedTransport::DeviceUse BeginDevice();

  /**
   * Call it after the run. Warns once for all ranks if the device of one did not serve. Collective.
   */
  void EndDevice(const RectifiedTransport::DeviceUse& device);

  /**
   * Warns on the first rank that EqualizeAreas has changed nothing.
   */
  void WarnOfAreas();

  int Method = RECTIFIED_FLOW;
  double OptimalityTolerance = 0.001;
  vtkTypeBool Certify = false;
  int Tables = TABLES_AUTO;
  int Integrator = MULTISTEP;
  int NumberOfSteps = 0;
  double AreaTolerance = 0.02;
  double Tolerance = 0.01;
  int TableLookup = INTERPOLATED;
  int FlowMaps = FLOW_MAPS_AUTO;
  int Device = DEVICE_CPU;

private:
  struct vtkDevice;
  std::unique_ptr<vtkDevice> OwnDevice;

  vtkTransportAlgorithm(const vtkTransportAlgorithm&) = delete;
  void operator=(const vtkTransportAlgorithm&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTransportAlgorithm
 * @brief   superclass of the filters that move points by a map between a density and the uniform
 *          measure
 *
 * The map is that of the flow (see vtkFlowAlgorithm). With Method Optimal the map of least mean
 * squared distance takes its place (see
 * OptimalMap.h in the core): by the back-and-forth method of Jacobs and Leger, "A fast approach to
 * optimal transport: the back-and-forth method", Numerische Mathematik 146, 2020,
 * doi:10.1007/s00211-020-01154-8. With it, or with Certify, outputs have the field data
 * - `TransportCostLowerBound`: no map between the uniform measure and the density costs less. This
 *   is certified, up to rounding; it is not the distance itself;
 * - `OptimalityGap`: the cost of the map that is delivered over the bound, less one, not below 0.
 * It has the errors of the map's masses and of the samples that the cost is from. Where the bound
 * is 0, it is 0 for a cost of 0 up to rounding, else infinite.
 *
 * This class holds the properties of the method, of the tables and of the device.
 *
 * @sa vtkFlowAlgorithm vtkDensityAlgorithm vtkTransportSampler vtkTransportMap
 */
#ifndef vtkTransportAlgorithm_h
#define vtkTransportAlgorithm_h

#include "vtkFlowAlgorithm.h"
#include "vtkRectifiedTransportCommonModule.h" // for the export macro

#include <memory> // for std::unique_ptr

namespace RectifiedTransport
{
class DeviceUse;
namespace Bridge
{
struct TransportSettings;
} // namespace Bridge
} // namespace RectifiedTransport

VTK_ABI_NAMESPACE_BEGIN
class vtkStringArray;

class VTKRECTIFIEDTRANSPORTCOMMON_EXPORT vtkTransportAlgorithm : public vtkFlowAlgorithm
{
public:
  vtkTypeMacro(vtkTransportAlgorithm, vtkFlowAlgorithm);
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
   * Method, OptimalityTolerance, Certify, Tables and the properties of the integration, checked; so
   * is Device. Throws what RequestData may throw.
   */
  RectifiedTransport::Bridge::TransportSettings GetTransportSettings();

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
  int Device = DEVICE_CPU;

private:
  struct vtkDevice;
  std::unique_ptr<vtkDevice> OwnDevice;

  vtkTransportAlgorithm(const vtkTransportAlgorithm&) = delete;
  void operator=(const vtkTransportAlgorithm&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif

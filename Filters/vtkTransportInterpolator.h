// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTransportInterpolator
 * @brief   moves the mass of one density to another
 *
 * Where a cross-fade would show both densities at once, here each particle goes straight from its
 * place in the first density, `SourcePosition`, to its place in the second, `TargetPosition`, in
 * physical space. Both places come from one point of the unit box, the pivot (Section 3.4 of the
 * paper named in vtkTransportBlend; Section 5.2 shows results).
 *
 * Inputs: port 0 the source, port 1 the target, both vtkImageData; they may differ in size, spacing
 * and box. The density of the source is input array 0 (SetInputArrayToProcess(0, 0, ...)), that of
 * the target input array 1 (SetInputArrayToProcess(1, 1, ...)). The outputs are those of
 * vtkTransportBlend, and the particles have also `SourcePosition` and `TargetPosition` (3
 * components each, physical).
 *
 * A Parameter of 0 gives the source and one of 1 the target, up to what the kernel and the number
 * of particles resolve. The maps are kept: a change of Parameter, or of time, only interpolates
 * and splats.
 *
 * With PublishTime on the filter is a time source on [0,1] with NumberOfTimeSteps steps: the time
 * that the pipeline asks for takes the place of Parameter. The inputs are then asked for their
 * first time, if they have any, so that they stay the same while it plays.
 *
 * Images of different dimensions, planes or direction matrices are an error.
 *
 * @sa vtkTransportBlend vtkTransportBarycenter vtkMassSplatter vtkSolidDensity
 */
#ifndef vtkTransportInterpolator_h
#define vtkTransportInterpolator_h

#include "vtkTransportBlend.h"

namespace RectifiedTransport
{
class DensityBlend;
}

VTK_ABI_NAMESPACE_BEGIN
class vtkAlgorithmOutput;

class VTKRECTIFIEDTRANSPORT_EXPORT vtkTransportInterpolator : public vtkTransportBlend
{
public:
  static vtkTransportInterpolator* New();
  vtkTypeMacro(vtkTransportInterpolator, vtkTransportBlend);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Connect the target, input port 1.
   */
  void SetTargetConnection(vtkAlgorithmOutput* target);
  void SetTargetData(vtkDataObject* target);
  ///@}

  using vtkAlgorithm::SetInputArrayToProcess;
  /**
   * Choose the array of a density. One on port 1 is the target's, input array 1, also where `idx`
   * is 0, as ParaView gives it by default.
   */
  void SetInputArrayToProcess(
    int idx, int port, int connection, int fieldAssociation, const char* name) override;

  ///@{
  /**
   * How far the mass has come: 0 (the source) to 1 (the target). Default 0.5. With PublishTime on,
   * the pipeline's time takes its place.
   */
  vtkSetMacro(Parameter, double);
  vtkGetMacro(Parameter, double);
  ///@}

  ///@{
  /**
   * Publish the time steps of [0,1] and follow the pipeline's time, which is taken from the nearest
   * end where it is outside. Off by default.
   */
  vtkSetMacro(PublishTime, vtkTypeBool);
  vtkGetMacro(PublishTime, vtkTypeBool);
  vtkBooleanMacro(PublishTime, vtkTypeBool);
  ///@}

  ///@{
  /**
   * How many time steps PublishTime publishes, both ends included: 2 to 1000000, default 11.
   */
  vtkSetMacro(NumberOfTimeSteps, int);
  vtkGetMacro(NumberOfTimeSteps, int);
  ///@}

protected:
  vtkTransportInterpolator();
  ~vtkTransportInterpolator() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestUpdateTime(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  double Parameter;
  vtkTypeBool PublishTime;
  int NumberOfTimeSteps;

private:
  void KeepTimeFromInputs(vtkInformationVector** inputVector);
  double FindParameter(vtkInformation* request, vtkInformationVector* outputVector);
  std::unique_ptr<RectifiedTransport::DensityBlend> Blend;

  vtkTransportInterpolator(const vtkTransportInterpolator&) = delete;
  void operator=(const vtkTransportInterpolator&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif

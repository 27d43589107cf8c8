// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTransportInterpolator
 * @brief   move the mass of one density to another
 *
 * Each particle moves on a straight line in physical space from its position in the first density,
 * `SourcePosition`, to its position in the second, `TargetPosition`. A cross-fade would show both
 * densities at once instead. Both positions come from one point of the unit box, the pivot (Section
 * 3.4 of the paper named in vtkTransportBlend; Section 5.2 shows results).
 *
 * Inputs: port 0 is the source, port 1 the target, both data sets. They may differ in size, spacing
 * and box. The density of the source is input array 0 (SetInputArrayToProcess(0, 0, ...)), that of
 * the target input array 1 (SetInputArrayToProcess(1, 1, ...)). The outputs are those of
 * vtkTransportBlend; the particles also have `SourcePosition` and `TargetPosition` (3 components
 * each, physical) and `Displacement`, from the first to the second (active vectors). Both outputs
 * have the field data `TransportCost`: the mean of |Displacement|^2 over the mass, in squared
 * physical units. It does not depend on Parameter. It is an upper bound on W2^2 between the
 * densities, each divided by its mass.
 *
 * Parameter 0 gives the source and 1 the target. Cost and memory: see vtkTransportBlend. The maps
 * are kept: a change of Parameter or of the time only interpolates and splats.
 *
 * With PublishTime on, the filter is a time source on [0,1] with NumberOfTimeSteps steps: the
 * requested time replaces Parameter. If the inputs have times, their first time is requested, so
 * that they do not change with the requested time.
 *
 * Images of different dimensions, planes or direction matrices are an error. Elements of direction
 * matrices may differ by 1e-6; the output has those of the source.
 *
 * @sa vtkTransportBlend vtkTransportBarycenter vtkMassSplatter vtkSolidDensity
 */
#ifndef vtkTransportInterpolator_h
#define vtkTransportInterpolator_h

#include "vtkRectifiedTransportDensitiesModule.h" // for the export macro
#include "vtkTransportBlend.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkAlgorithmOutput;

class VTKRECTIFIEDTRANSPORTDENSITIES_EXPORT vtkTransportInterpolator : public vtkTransportBlend
{
public:
  static vtkTransportInterpolator* New();
  vtkTypeMacro(vtkTransportInterpolator, vtkTransportBlend);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Set the target (input 1), as the output of another filter.
   */
  void SetTargetConnection(vtkAlgorithmOutput* target) { this->SetInputConnection(1, target); }

  /**
   * The same, as a data object.
   */
  void SetTargetData(vtkDataObject* target) { this->SetInputData(1, target); }

  using vtkAlgorithm::SetInputArrayToProcess;
  /**
   * Choose the array of a density. With port 1 it is that of the target, input array 1, even if
   * `idx` is 0, which ParaView passes by default.
   */
  void SetInputArrayToProcess(
    int idx, int port, int connection, int fieldAssociation, const char* name) override;

  ///@{
  /**
   * The interpolation parameter, from 0 (the source) to 1 (the target). Default 0.5. With
   * PublishTime on, the requested time replaces it.
   */
  vtkSetMacro(Parameter, double);
  vtkGetMacro(Parameter, double);
  ///@}

  ///@{
  /**
   * Publish time steps on [0,1] and use the requested time, clamped to [0,1], as Parameter. Off by
   * default.
   */
  vtkSetMacro(PublishTime, vtkTypeBool);
  vtkGetMacro(PublishTime, vtkTypeBool);
  vtkBooleanMacro(PublishTime, vtkTypeBool);
  ///@}

  ///@{
  /**
   * The number of time steps that PublishTime publishes, both ends included: 2 to 1000000,
   * default 11.
   */
  vtkSetMacro(NumberOfTimeSteps, int);
  vtkGetMacro(NumberOfTimeSteps, int);
  ///@}

protected:
  vtkTransportInterpolator();
  ~vtkTransportInterpolator() override = default;

  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestUpdateTime(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  double Parameter = 0.5;
  vtkTypeBool PublishTime = false;
  int NumberOfTimeSteps = 11;

private:
  void RequestFirstTime(vtkInformationVector** inputVector);
  double FindParameter(vtkInformation* request, vtkInformationVector* outputVector);

  vtkTransportInterpolator(const vtkTransportInterpolator&) = delete;
  void operator=(const vtkTransportInterpolator&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif

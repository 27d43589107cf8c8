// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTransportBarycenter
 * @brief   the weighted mean of several densities, by transport
 *
 * The (linearized) barycenters of Section 5.3 of the paper named in vtkTransportBlend. Each
 * particle of the unit box is mapped to each density and placed at the weighted mean of these
 * positions.
 *
 * Inputs: one or more data sets, as connections to port 0 or as the blocks of a composite data set
 * (vtkMultiBlockDataSet, vtkPartitionedDataSetCollection), in their order. The one density array
 * (SetInputArrayToProcess(0, 0, ...)) is looked up in all of them. The outputs are those of
 * vtkTransportBlend. Their extent is announced in REQUEST_INFORMATION, for composite inputs only
 * when their blocks exist.
 *
 * Cost and memory: see vtkTransportBlend. The maps are kept. A change of the weights only computes
 * means and splats: 25 barycenters of 4 densities cost 4 maps and 25 splats. Weights 1, 0, 0 ...
 * give the first density.
 *
 * @sa vtkTransportBlend vtkTransportInterpolator vtkMassSplatter
 */
#ifndef vtkTransportBarycenter_h
#define vtkTransportBarycenter_h

#include "vtkRectifiedTransportDensitiesModule.h" // for the export macro
#include "vtkTransportBlend.h"

VTK_ABI_NAMESPACE_BEGIN
class VTKRECTIFIEDTRANSPORTDENSITIES_EXPORT vtkTransportBarycenter : public vtkTransportBlend
{
public:
  static vtkTransportBarycenter* New();
  vtkTypeMacro(vtkTransportBarycenter, vtkTransportBlend);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The weights of the inputs, in their order: one for each, none negative, with a sum above 0.
   * They are divided by their sum. By default there are none, and all inputs weigh the same. The
   * count is at most 1000000.
   */
  void SetNumberOfWeights(int count);
  int GetNumberOfWeights();
  ///@}

  ///@{
  /**
   * One of the weights. The list grows as needed, with 0 for weights that are not set.
   */
  void SetWeight(int index, double weight);
  double GetWeight(int index);
  ///@}

protected:
  vtkTransportBarycenter();
  ~vtkTransportBarycenter() override;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  struct vtkWeights;
  std::unique_ptr<vtkWeights> Weights;

  vtkTransportBarycenter(const vtkTransportBarycenter&) = delete;
  void operator=(const vtkTransportBarycenter&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif

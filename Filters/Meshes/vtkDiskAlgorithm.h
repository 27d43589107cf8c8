// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDiskAlgorithm
 * @brief   superclass of the filters that map a surface to a square
 *
 * The input is a vtkPolyData, a vtkUnstructuredGrid or a vtkStructuredGrid, whose polygons form a
 * disk, unless a filter says otherwise; the output is a vtkPolyData. With several MPI ranks the
 * surface is gathered on rank 0, which has the output.
 *
 * This class holds the corners of the square.
 *
 * @sa vtkAreaPreservingParameterization vtkSurfaceSampler
 */
#ifndef vtkDiskAlgorithm_h
#define vtkDiskAlgorithm_h

#include "vtkCollectiveAlgorithm.h"
#include "vtkPolyData.h"
#include "vtkRectifiedTransportMeshesModule.h" // for the export macro

#include <memory> // for std::unique_ptr

namespace RectifiedTransport
{
struct CornerSettings;
} // namespace RectifiedTransport

VTK_ABI_NAMESPACE_BEGIN
class VTKRECTIFIEDTRANSPORTMESHES_EXPORT vtkDiskAlgorithm : public vtkCollectiveAlgorithm
{
public:
  vtkTypeMacro(vtkDiskAlgorithm, vtkCollectiveAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The points of the surface's boundary that become the corners of the unit square: four point
   * ids. The first goes to (0,0), the others, in the order of the boundary, to (1,0), (1,1) and
   * (0,1). By default there are none, and the corners are chosen automatically. The count is at
   * most 1000000.
   */
  void SetNumberOfCorners(int count);
  int GetNumberOfCorners();
  void ClearCorners() { this->SetNumberOfCorners(0); }
  ///@}

  ///@{
  /**
   * One of the corners. The list grows as needed, with -1 for corners that are not set.
   */
  void SetCorner(int index, vtkIdType point);
  vtkIdType GetCorner(int index);
  ///@}

  /**
   * The output.
   */
  vtkPolyData* GetOutput() { return vtkPolyData::SafeDownCast(this->GetOutputDataObject(0)); }

protected:
  vtkDiskAlgorithm();
  ~vtkDiskAlgorithm() override;

  /**
   * The corners, not checked.
   */
  RectifiedTransport::CornerSettings GetCorners() const;

private:
  struct vtkCorners;
  std::unique_ptr<vtkCorners> Corners;

  vtkDiskAlgorithm(const vtkDiskAlgorithm&) = delete;
  void operator=(const vtkDiskAlgorithm&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif

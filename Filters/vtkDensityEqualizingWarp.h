// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDensityEqualizingWarp
 * @brief   move points so that a density becomes uniform
 *
 * Moves the points of any vtkPointSet by the map that takes a density to the uniform measure on its
 * domain: where the density is high, space grows, where it is low, it shrinks. A map of a country
 * becomes a cartogram. The map is the rectified flow of Do, Coeurjolly, Memari and Bonneel,
 * "Linear-Time Transport with Rectified Flows", ACM Transactions on Graphics 44(4), 2025,
 * doi:10.1145/3731147, followed back in time (Section 4.2). It is the inverse of what
 * vtkTransportSampler does, and as little as that an optimal transport.
 *
 * Input 0 is the vtkPointSet, input 1 the density, a vtkImageData (see vtkDensityAlgorithm), chosen
 * with SetInputArrayToProcess(0, 1, 0, ...). The output is of the type of input 0: the same points
 * and cells in the same order with all their data, the points moved and double, and point data
 * `Displacement` (how far each point was moved, 3 components in physical units, active vectors),
 * which replaces a namesake.
 *
 * What lies across the axes of a density of one or two dimensions is kept: points above the plane
 * of the image move as their feet do. A point beyond the border moves as the border's nearest point
 * (axis by axis) and so keeps its offset from it; one warning counts such points. NaN or infinite
 * coordinates are an error.
 *
 * Regions without mass shrink to nothing: points there fall onto points of others, up to the error
 * of the integrator. Add a small number to the density to keep cells apart.
 *
 * Normals are passed on as they are, although the surface bends.
 *
 * Cost: O(cells) for the tables, which are kept until the density changes, and O(points * steps).
 * Memory: 48 bytes a point for the output and while it runs 16 more in 2D, beside the tables (see
 * vtkTransportAlgorithm).
 *
 * \code{.cpp}
 * vtkNew<vtkDensityEqualizingWarp> warp;
 * warp->SetInputData(borders);    // a vtkPolyData
 * warp->SetDensityData(people);   // a vtkImageData
 * warp->Update();
 * vtkPointSet* cartogram = warp->GetOutput();
 * \endcode
 *
 * @sa vtkTransportSampler vtkTransportAlgorithm vtkDensityAlgorithm vtkWarpVector
 */
#ifndef vtkDensityEqualizingWarp_h
#define vtkDensityEqualizingWarp_h

#include "vtkTransportAlgorithm.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkAlgorithmOutput;
class vtkPointSet;

class VTKRECTIFIEDTRANSPORT_EXPORT vtkDensityEqualizingWarp : public vtkTransportAlgorithm
{
public:
  static vtkDensityEqualizingWarp* New();
  vtkTypeMacro(vtkDensityEqualizingWarp, vtkTransportAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * How far the points go, in [0,1]: 0 leaves them where they are, 1 (default) is the whole map; in
   * between they are on the straight line.
   */
  vtkSetMacro(Blend, double);
  vtkGetMacro(Blend, double);
  ///@}

  ///@{
  /**
   * Give the density (input 1) as the output of another filter, or as data.
   */
  void SetDensityConnection(vtkAlgorithmOutput* density);
  void SetDensityData(vtkDataObject* density);
  ///@}

  /**
   * The points where they now are, with cells and data.
   */
  vtkPointSet* GetOutput();

protected:
  vtkDensityEqualizingWarp();
  ~vtkDensityEqualizingWarp() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  bool NeedsWhole(int port) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  double Blend;

private:
  vtkDensityEqualizingWarp(const vtkDensityEqualizingWarp&) = delete;
  void operator=(const vtkDensityEqualizingWarp&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif

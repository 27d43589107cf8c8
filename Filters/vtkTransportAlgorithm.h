// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTransportAlgorithm
 * @brief   superclass of the filters that move points along the rectified flow of a density
 *
 * The flow is that of Do, Coeurjolly, Memari and Bonneel, "Linear-Time Transport with Rectified
 * Flows", ACM Transactions on Graphics 44(4), 2025, doi:10.1145/3731147: points that are uniform at
 * time 0 follow the velocity field of its equation 12, which needs the mass and the centroid of the
 * density in a box (equations 10 and 11); both come from summed-area tables (Section 3.3).
 *
 * This class holds the properties of the integration; see vtkTransportProperties.h.
 *
 * @sa vtkDensityAlgorithm vtkTransportSampler vtkTransportMap
 */
#ifndef vtkTransportAlgorithm_h
#define vtkTransportAlgorithm_h

#include "vtkDensityAlgorithm.h"
#include "vtkTransportProperties.h" // for the integration of the flow

VTK_ABI_NAMESPACE_BEGIN

class VTKRECTIFIEDTRANSPORT_EXPORT vtkTransportAlgorithm : public vtkDensityAlgorithm
{
public:
  vtkTypeMacro(vtkTransportAlgorithm, vtkDensityAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  vtkFlowPropertiesMacro();

protected:
  /**
   * The density is on input port `densityPort`.
   */
  explicit vtkTransportAlgorithm(int densityPort = 0);
  ~vtkTransportAlgorithm() override;

private:
  vtkTransportAlgorithm(const vtkTransportAlgorithm&) = delete;
  void operator=(const vtkTransportAlgorithm&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif

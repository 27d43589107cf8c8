// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTransportEnumerations
 * @brief   what the properties may be that several filters have
 *
 * Each enumeration of properties that more than one filter has is here, once: all filters of the
 * module inherit this class. An enumeration of a single filter is in its class. An enumerator's
 * name has the same value in all classes.
 *
 * @sa vtkCollectiveAlgorithm
 */
#ifndef vtkTransportEnumerations_h
#define vtkTransportEnumerations_h

#include "Bridge/VTKCompatibility.h"
#include "vtkAlgorithm.h"
#include "vtkRectifiedTransportCommonModule.h" // for the export macro

VTK_ABI_NAMESPACE_BEGIN
class VTKRECTIFIEDTRANSPORTCOMMON_EXPORT vtkTransportEnumerations : public vtkAlgorithm
{
public:
  vtkTypeMacro(vtkTransportEnumerations, vtkAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

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

  /**
   * What Method may be where it is a map between densities.
   */
  enum TransportMethodType
  {
    RECTIFIED_FLOW = 0,
    OPTIMAL = 1
  };

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
   * What FlowMaps may be.
   */
  enum FlowMapsType
  {
    FLOW_MAPS_AUTO = 0,
    FLOW_MAPS_ON = 1,
    FLOW_MAPS_OFF = 2
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
   * What Tables may be.
   */
  enum TablesType
  {
    TABLES_AUTO = 0,
    TABLES_WHOLE = 1,
    TABLES_TILED = 2
  };

  /**
   * What SeedPattern may be, and Pattern of vtkUniformSeedSource.
   */
  enum SeedPatternType
  {
    BLUE_NOISE = 0,
    LATTICE = 1,
    JITTERED = 2,
    LOW_DISCREPANCY = 3,
    RANDOM = 4
  };

  /**
   * What Kernel may be: how mass is spread over the cells around it (see vtkMassSplatter).
   */
  enum KernelType
  {
    CLOUD_IN_CELL = 0,
    NEAREST_CELL = 1,
    TRIANGULAR_SHAPED_CLOUD = 2,
    GAUSSIAN = 3
  };

  /**
   * What Association may be.
   */
  enum AssociationType
  {
    POINTS = 0,
    CELLS = 1
  };

  /**
   * What EmptyCells may be.
   */
  enum EmptyCellsType
  {
    EMPTY_CELLS_ZERO = 0,
    EMPTY_CELLS_MEAN = 1,
    EMPTY_CELLS_MINIMUM = 2,
    EMPTY_CELLS_VALUE = 3
  };

protected:
  vtkTransportEnumerations() = default;
  ~vtkTransportEnumerations() override = default;

private:
  vtkTransportEnumerations(const vtkTransportEnumerations&) = delete;
  void operator=(const vtkTransportEnumerations&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif

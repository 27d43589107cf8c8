// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMVectorWriterInitializationHelper
 * @brief   a drawing looks at first as the data look in the active view
 *
 * For the writers of SVG and PDF: takes ColorArray and LookupTable from the data's representation
 * in the active view, and PointRadius if that shows plain circles. What the data do not show there
 * stays at its default.
 */
#ifndef vtkSMVectorWriterInitializationHelper_h
#define vtkSMVectorWriterInitializationHelper_h

#include "vtkSMProxyInitializationHelper.h"

class vtkSMVectorWriterInitializationHelper : public vtkSMProxyInitializationHelper
{
public:
  static vtkSMVectorWriterInitializationHelper* New();
  vtkTypeMacro(vtkSMVectorWriterInitializationHelper, vtkSMProxyInitializationHelper);

  /**
   * Leaves properties alone that were set after `time`.
   */
  void PostInitializeProxy(vtkSMProxy* writer, vtkPVXMLElement* hints, vtkMTimeType time) override;

protected:
  vtkSMVectorWriterInitializationHelper() = default;
  ~vtkSMVectorWriterInitializationHelper() override = default;

private:
  vtkSMVectorWriterInitializationHelper(const vtkSMVectorWriterInitializationHelper&) = delete;
  void operator=(const vtkSMVectorWriterInitializationHelper&) = delete;
};

#endif

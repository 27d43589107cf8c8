// SPDX-License-Identifier: BSD-3-Clause
// VTK's header of this name, as it is where VTK was configured with a namespace.
#ifndef vtkABINamespace_h
#define vtkABINamespace_h

#define VTK_ABI_NAMESPACE_BEGIN                                                                    \
  inline namespace vtk_test_namespace                                                              \
  {
#define VTK_ABI_NAMESPACE_END }

#endif

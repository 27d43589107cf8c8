// SPDX-License-Identifier: BSD-3-Clause
// What the sources of filter kinds share.
#ifndef Campaign_Kinds_h
#define Campaign_Kinds_h

#include "FilterKind.h"

namespace Campaign
{

template <class T>
vtkSmartPointer<vtkAlgorithm> make()
{
  return vtkSmartPointer<T>::New();
}

// Of a filter that is quick as it is.
inline void leaveAsItIs(RandomSource&, vtkAlgorithm*) {}

} // namespace Campaign

#endif

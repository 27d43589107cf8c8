// SPDX-License-Identifier: BSD-3-Clause
// The parts of the list of filter kinds.
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

FilterKind transportMapKind();
FilterKind distanceKind();
FilterKind temporalKind();
void addTransportKinds(std::vector<FilterKind>& kinds);
void addBlendKinds(std::vector<FilterKind>& kinds);
void addOtherKinds(std::vector<FilterKind>& kinds);
void addSurfaceKinds(std::vector<FilterKind>& kinds);
void addMapKinds(std::vector<FilterKind>& kinds);

} // namespace Campaign

#endif

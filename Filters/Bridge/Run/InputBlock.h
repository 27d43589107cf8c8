// SPDX-License-Identifier: BSD-3-Clause
// The data of an input as the type that a filter needs. Executives see to it, but not for the
// blocks of composite data.
#ifndef RectifiedTransport_InputBlock_h
#define RectifiedTransport_InputBlock_h

#include "Bridge/Run/Failure.h"

#include "vtkDataObject.h"

#include <string>

namespace RectifiedTransport
{

// nullptr if there are no data. Throws Failure for another type; `what` begins the message, and
// `rule` completes "it must be ...".
template <class DataT>
DataT* requireBlock(vtkDataObject* data, const char* what, const char* rule)
{
  DataT* block = DataT::SafeDownCast(data);
  if (data && !block)
  {
    throw Failure(
      std::string(what) + " has a block of type " + data->GetClassName() + "; it must be " + rule);
  }
  return block;
}

} // namespace RectifiedTransport

#endif

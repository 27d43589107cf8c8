// SPDX-License-Identifier: BSD-3-Clause
// An input data object cast to the required type. Executives check the type of an input, but not
// that of the blocks of a composite one.
#ifndef RectifiedTransport_InputBlock_h
#define RectifiedTransport_InputBlock_h

#include "Core/Messages/Failure.h"

#include "vtkDataObject.h"

#include <string>

namespace RectifiedTransport::Bridge
{

// nullptr if there is no data object. Throws Failure for another type; `what` begins the message,
// and `rule` completes "it must be ...".
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

} // namespace RectifiedTransport::Bridge

#endif

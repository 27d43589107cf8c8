// SPDX-License-Identifier: BSD-3-Clause
// What messages call a block of a composite data set.
#ifndef RectifiedTransport_BlockName_h
#define RectifiedTransport_BlockName_h

#include "Bridge/VTKCompatibility.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkInformation.h"
#include "vtkInformationStringKey.h"

#include <string>

namespace RectifiedTransport::Bridge
{

// "block 3 ('name') of the input", of the block that the iterator is at.
inline std::string nameOfBlock(vtkCompositeDataIterator* leaves)
{
  std::string name = "block " + std::to_string(leaves->GetCurrentFlatIndex());
  vtkInformation* information =
    leaves->HasCurrentMetaData() ? leaves->GetCurrentMetaData() : nullptr;
  if (information && information->Has(vtkCompositeDataSet::NAME()))
  {
    name += " ('" + std::string(information->Get(vtkCompositeDataSet::NAME())) + "')";
  }
  return name + " of the input";
}

} // namespace RectifiedTransport::Bridge

#endif

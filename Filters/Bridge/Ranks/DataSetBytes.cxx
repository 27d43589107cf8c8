// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Ranks/DataSetBytes.h"

#include "Core/Messages/Failure.h"
#include "Core/Parallel/RankExchange.h"

#include "vtkDataSet.h"

#if VTK_MODULE_ENABLE_VTK_ParallelMPI
#include "vtkAbstractArray.h"
#include "vtkCharArray.h"
#include "vtkCommunicator.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <vector>
#endif

namespace RectifiedTransport::Bridge
{

#if VTK_MODULE_ENABLE_VTK_ParallelMPI

namespace
{

// What VTK's message has not: the geometry of images in full, and which arrays are active (its
// format puts these first).
struct Header
{
  std::uint64_t Arrays = 0; // whose types follow
  bool IsImage = false;
  std::array<int, 6> Extent{};
  std::array<double, 15> Geometry{}; // origin, spacing, direction
  std::array<std::array<int, vtkDataSetAttributes::NUM_ATTRIBUTES>, 2> Active{};
};

constexpr std::array<int, 2> owners = { vtkDataObject::POINT, vtkDataObject::CELL };

Header headerOf(vtkDataSet* data)
{
  Header header;
  if (auto* image = vtkImageData::SafeDownCast(data))
  {
    header.IsImage = true;
    image->GetExtent(header.Extent.data());
    std::copy_n(image->GetOrigin(), 3, header.Geometry.begin());
    std::copy_n(image->GetSpacing(), 3, header.Geometry.begin() + 3);
    std::copy_n(image->GetDirectionMatrix()->GetData(), 9, header.Geometry.begin() + 6);
  }
  for (std::size_t i = 0; i < owners.size(); ++i)
  {
    data->GetAttributes(owners[i])->GetAttributeIndices(header.Active[i].data());
  }
  return header;
}

// The types of the arrays of numbers, which VTK may replace by others of the same size.
std::vector<int> typesOf(vtkDataSet* data)
{
  std::vector<int> types;
  for (const int owner : owners)
  {
    vtkDataSetAttributes* attributes = data->GetAttributes(owner);
    for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
    {
      types.push_back(attributes->GetAbstractArray(i)->GetDataType());
    }
  }
  return types;
}

void restoreTypes(vtkDataSet* data, const std::vector<int>& types)
{
  std::size_t next = 0;
  for (const int owner : owners)
  {
    vtkDataSetAttributes* attributes = data->GetAttributes(owner);
    for (int i = 0; i < attributes->GetNumberOfArrays() && next < types.size(); ++i, ++next)
    {
      vtkDataArray* array = attributes->GetArray(i);
      if (!array || array->GetDataType() == types[next])
      {
        continue;
      }
      const auto made =
        vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(types[next]));
      if (made->GetDataTypeSize() != array->GetDataTypeSize())
      {
        continue;
      }
      made->SetName(array->GetName());
      made->SetNumberOfComponents(array->GetNumberOfComponents());
      made->SetNumberOfTuples(array->GetNumberOfTuples());
      made->CopyComponentNames(array);
      std::memcpy(made->GetVoidPointer(0), array->GetVoidPointer(0),
        static_cast<std::size_t>(array->GetNumberOfValues()) *
          static_cast<std::size_t>(array->GetDataTypeSize()));
      attributes->AddArray(made); // in the place of the one of its name
    }
  }
}

} // namespace

Bytes bytesOfDataSet(vtkDataSet* data)
{
  // VTK sends images, but not the vtkUniformGrid of AMR.
  vtkSmartPointer<vtkDataSet> plain;
  if (data->IsA("vtkUniformGrid"))
  {
    plain = vtkSmartPointer<vtkImageData>::New();
  }
  else
  {
    plain.TakeReference(data->NewInstance());
  }
  plain->ShallowCopy(data);
  for (const int owner : owners)
  {
    vtkDataSetAttributes* attributes = plain->GetAttributes(owner);
    for (int type = 0; type < vtkDataSetAttributes::NUM_ATTRIBUTES; ++type)
    {
      attributes->SetActiveAttribute(-1, type);
    }
  }
  vtkNew<vtkCharArray> message;
  if (!vtkCommunicator::MarshalDataObject(plain, message))
  {
    throw Failure("Data of the type " + std::string(data->GetClassName()) +
      " cannot be gathered from several ranks; convert them to an unstructured grid before");
  }
  const std::vector<int> types = typesOf(data);
  Header header = headerOf(data);
  header.Arrays = types.size();
  Bytes bytes = toBytes(&header, 1);
  const Bytes kinds = toBytes(types);
  bytes.insert(bytes.end(), kinds.begin(), kinds.end());
  const char* text = message->GetPointer(0);
  bytes.insert(bytes.end(), text, text + message->GetNumberOfValues());
  return bytes;
}

vtkSmartPointer<vtkDataSet> dataSetOfBytes(const char* bytes, std::size_t count)
{
  Header header;
  std::memcpy(&header, bytes, sizeof(header));
  const std::size_t begin = sizeof(header) + header.Arrays * sizeof(int);
  const std::vector<int> types = fromBytes<int>(Bytes(bytes + sizeof(header), bytes + begin));
  vtkNew<vtkCharArray> message;
  // VTK takes no constant memory, but only reads it.
  message->SetArray(const_cast<char*>(bytes + begin), static_cast<vtkIdType>(count - begin), 1);
  const vtkSmartPointer<vtkDataObject> object = vtkCommunicator::UnMarshalDataObject(message);
  vtkSmartPointer<vtkDataSet> made = vtkDataSet::SafeDownCast(object);
  if (!made)
  {
    throw Failure("Data of another rank could not be read");
  }
  if (header.IsImage)
  {
    const auto image = vtkSmartPointer<vtkImageData>::New();
    image->SetExtent(header.Extent.data());
    image->SetOrigin(header.Geometry.data());
    image->SetSpacing(header.Geometry.data() + 3);
    image->SetDirectionMatrix(header.Geometry.data() + 6);
    for (const int owner : owners)
    {
      image->GetAttributes(owner)->ShallowCopy(made->GetAttributes(owner));
    }
    image->GetFieldData()->ShallowCopy(made->GetFieldData());
    made = image;
  }
  restoreTypes(made, types);
  for (std::size_t i = 0; i < owners.size(); ++i)
  {
    for (int type = 0; type < vtkDataSetAttributes::NUM_ATTRIBUTES; ++type)
    {
      made->GetAttributes(owners[i])->SetActiveAttribute(
        header.Active[i][static_cast<std::size_t>(type)], type);
    }
  }
  return made;
}

#else

Bytes bytesOfDataSet(vtkDataSet*)
{
  throw Failure("This build has no MPI");
}

vtkSmartPointer<vtkDataSet> dataSetOfBytes(const char*, std::size_t)
{
  throw Failure("This build has no MPI");
}

#endif

} // namespace RectifiedTransport::Bridge

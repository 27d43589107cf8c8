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
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkTypeInt64Array.h"

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
// A message is this header, the types of its arrays (one int each), and the bytes of
// vtkGenericDataObjectWriter. Ranks run the same program on machines of one kind, so that bytes
// need no conversion.
struct Header
{
  std::uint64_t Arrays = 0; // whose types follow
  bool IsImage = false;
  std::array<int, 6> Extent{};
  std::array<double, 15> Geometry{}; // origin, spacing, direction
  std::array<std::array<int, vtkDataSetAttributes::NUM_ATTRIBUTES>, 2> Active{};
};

// The order of the types in a message: the arrays of points first, then those of cells.
constexpr std::array<int, 2> dataOwners = { vtkDataObject::POINT, vtkDataObject::CELL };

Header headerOf(vtkDataSet* data)
{
  Header header;
  // Row-major 3 x 3 direction, as vtkMatrix3x3 has it.
  if (auto* image = vtkImageData::SafeDownCast(data))
  {
    header.IsImage = true;
    image->GetExtent(header.Extent.data());
    std::copy_n(image->GetOrigin(), 3, header.Geometry.begin());
    std::copy_n(image->GetSpacing(), 3, header.Geometry.begin() + 3);
    std::copy_n(image->GetDirectionMatrix()->GetData(), 9, header.Geometry.begin() + 6);
  }
  for (std::size_t i = 0; i < dataOwners.size(); ++i)
  {
    // For each attribute type (scalars, vectors, global ids, ...) the index of its array, -1 for
    // none.
    data->GetAttributes(dataOwners[i])->GetAttributeIndices(header.Active[i].data());
  }
  return header;
}

// The types of the arrays of numbers, which VTK may replace by others of the same size.
std::vector<int> typesOf(vtkDataSet* data)
{
  // The names of types in VTK's legacy format do not tell all types of one size apart.
  std::vector<int> types;
  for (const int owner : dataOwners)
  {
    vtkDataSetAttributes* attributes = data->GetAttributes(owner);
    for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
    {
      types.push_back(attributes->GetAbstractArray(i)->GetDataType());
    }
  }
  return types;
}

// Gives arrays that VTK has read as another type of the same size their own type back. Bits are
// copied, not converted. Arrays of text have no other type and stay.
void restoreTypes(vtkDataSet* data, const std::vector<int>& types)
{
  std::size_t next = 0;
  for (const int owner : dataOwners)
  {
    vtkDataSetAttributes* attributes = data->GetAttributes(owner);
    for (int i = 0; i < attributes->GetNumberOfArrays() && next < types.size(); ++i, ++next)
    {
      vtkDataArray* array = attributes->GetArray(i);
      // nullptr: an array of text, which is no vtkDataArray.
      if (!array || array->GetDataType() == types[next])
      {
        continue;
      }
      const auto made =
        vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(types[next]));
      // Bits of another size cannot be copied: the array stays as the reader has made it.
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

// VTK's writer narrows ids to 32 bits. They travel as integers of 64, and get their own type back
// as others do. The memory is shared with the given arrays.
void widenIds(vtkDataSetAttributes* attributes)
{
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
  {
    auto* ids = vtkIdTypeArray::SafeDownCast(attributes->GetAbstractArray(i));
    if (ids && ids->GetName() && sizeof(vtkIdType) == sizeof(vtkTypeInt64))
    {
      vtkNew<vtkTypeInt64Array> wide;
      wide->SetName(ids->GetName());
      wide->SetNumberOfComponents(ids->GetNumberOfComponents());
      wide->CopyComponentNames(ids);
      wide->SetArray(
        reinterpret_cast<vtkTypeInt64*>(ids->GetPointer(0)), ids->GetNumberOfValues(), 1);
      attributes->AddArray(wide); // in the place of the one of its name
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
  // A shallow copy, because the active attributes of the caller's data set must not change.
  plain->ShallowCopy(data);
  for (const int owner : dataOwners)
  {
    vtkDataSetAttributes* attributes = plain->GetAttributes(owner);
    // Without active attributes the writer keeps the order of the arrays, so that indices stay
    // valid.
    for (int type = 0; type < vtkDataSetAttributes::NUM_ATTRIBUTES; ++type)
    {
      attributes->SetActiveAttribute(-1, type);
    }
    widenIds(attributes);
  }
  vtkNew<vtkCharArray> message;
  if (!vtkCommunicator::MarshalDataObject(plain, message))
  {
    throw Failure("Data of the type " + std::string(data->GetClassName()) +
      " cannot be gathered from several ranks; convert them to an unstructured grid before");
  }
  // Types and attributes of the caller's data set: those of the copy are no longer active.
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
  // The object owns its arrays: nothing refers to `bytes` afterwards, which the caller may free.
  const vtkSmartPointer<vtkDataObject> object = vtkCommunicator::UnMarshalDataObject(message);
  vtkSmartPointer<vtkDataSet> made = vtkDataSet::SafeDownCast(object);
  if (!made)
  {
    throw Failure("Data of another rank could not be read");
  }
  // The image that VTK has read lacks the geometry in full: its arrays go to one that has it.
  if (header.IsImage)
  {
    const auto image = vtkSmartPointer<vtkImageData>::New();
    image->SetExtent(header.Extent.data());
    image->SetOrigin(header.Geometry.data());
    image->SetSpacing(header.Geometry.data() + 3);
    image->SetDirectionMatrix(header.Geometry.data() + 6);
    for (const int owner : dataOwners)
    {
      image->GetAttributes(owner)->ShallowCopy(made->GetAttributes(owner));
    }
    image->GetFieldData()->ShallowCopy(made->GetFieldData());
    made = image;
  }
  // The attributes come last, when each array is the one that stays.
  restoreTypes(made, types);
  for (std::size_t i = 0; i < dataOwners.size(); ++i)
  {
    for (int type = 0; type < vtkDataSetAttributes::NUM_ATTRIBUTES; ++type)
    {
      made->GetAttributes(dataOwners[i])
        ->SetActiveAttribute(header.Active[i][static_cast<std::size_t>(type)], type);
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

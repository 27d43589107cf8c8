// SPDX-License-Identifier: BSD-3-Clause
// What moves along with a cartogram: points in blocks, without points, beyond the map, and of types
// that no overlay has.
#include "MapRegions.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPartitionedDataSet.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

namespace
{

vtkSmartPointer<vtkCartogram> makeCartogram()
{
  auto cartogram = vtkSmartPointer<vtkCartogram>::New();
  cartogram->SetInputData(makeMap(4));
  cartogram->SetResolution(64);
  return cartogram;
}

vtkSmartPointer<vtkPolyData> makeRivers()
{
  auto rivers = makePoints({ 0.5, 0.5, 0, 1.5, 2.5, 0, 3.5, 1, 0 });
  vtkNew<vtkCellArray> lines;
  const vtkIdType ids[3] = { 0, 1, 2 };
  lines->InsertNextCell(3, ids);
  rivers->SetLines(lines);
  rivers->GetPointData()->AddArray(rivers->GetPoints()->GetData());
  return rivers;
}

Values movedAlone(vtkPointSet* overlay)
{
  auto cartogram = makeCartogram();
  cartogram->SetOverlayData(overlay);
  cartogram->Update();
  return coordinates(cartogram->GetOverlay());
}

void checkBlocks(Checks& checks)
{
  auto rivers = makeRivers();
  vtkNew<vtkUnstructuredGrid> cities;
  cities->SetPoints(makePoints({ 2.2, 2.1, 0, 0.1, 3.9, 0 })->GetPoints());
  vtkNew<vtkMultiBlockDataSet> inner;
  inner->SetBlock(2, rivers);
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, inner);
  blocks->SetBlock(3, cities);
  auto cartogram = makeCartogram();
  Messages messages(cartogram);
  cartogram->SetOverlayData(blocks);
  cartogram->Update();
  CHECK(checks, messages.Errors.empty() && messages.Warnings.empty());
  CHECK(checks, cartogram->GetOverlay() == nullptr);
  CHECK(checks, cartogram->GetRegions() && cartogram->GetRegions()->GetNumberOfPolys() == 16);
  auto* moved = vtkMultiBlockDataSet::SafeDownCast(cartogram->GetOutputDataObject(2));
  auto* movedInner = moved ? vtkMultiBlockDataSet::SafeDownCast(moved->GetBlock(0)) : nullptr;
  auto* movedRivers = movedInner ? vtkPolyData::SafeDownCast(movedInner->GetBlock(2)) : nullptr;
  auto* movedCities = moved ? vtkUnstructuredGrid::SafeDownCast(moved->GetBlock(3)) : nullptr;
  CHECK(checks, moved && moved->GetNumberOfBlocks() == 4 && movedRivers && movedCities);
  if (!movedRivers || !movedCities)
  {
    return;
  }
  CHECK(checks, coordinates(movedRivers) == movedAlone(rivers));
  CHECK(checks, coordinates(movedCities) == movedAlone(cities));
  CHECK(checks, largestDifference(coordinates(movedRivers), coordinates(rivers)) > 0.05);
  CHECK(checks, movedRivers->GetNumberOfLines() == 1);
  CHECK(checks, movedRivers->GetPointData()->GetNumberOfArrays() == 1);
  // Other types of composites, and one data set again.
  vtkNew<vtkPartitionedDataSet> parts;
  parts->SetPartition(1, rivers);
  cartogram->SetOverlayData(parts);
  cartogram->Update();
  auto* movedParts = vtkPartitionedDataSet::SafeDownCast(cartogram->GetOutputDataObject(2));
  CHECK(checks, movedParts && movedParts->GetNumberOfPartitions() == 2);
  cartogram->SetOverlayData(cities);
  cartogram->Update();
  CHECK(checks, cartogram->GetOverlay() && cartogram->GetOverlay()->GetNumberOfPoints() == 2);
  CHECK(checks, messages.Errors.empty());
}

void checkOthers(Checks& checks)
{
  auto cartogram = makeCartogram();
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, makeRivers());
  blocks->SetBlock(1, makeImage(3, 3, 1, true, bumpy));
  cartogram->SetOverlayData(blocks);
  {
    Messages messages(cartogram);
    cartogram->Update();
    CHECK(checks,
      messages.IsOneError("Overlay has a block of type vtkImageData; it must be a vtkPointSet, as "
                          "Extract Surface makes one of it"));
    CHECK(checks, cartogram->GetRegions()->GetNumberOfPoints() == 0);
  }
  cartogram->SetOverlayData(makePoints({ 1, 1, 0, std::nan(""), 1, 0 }));
  ErrorTest(checks, cartogram)
    .Expect("The Overlay has 1 point that is NaN or infinite, the first at index 1", __LINE__);
  auto broken = makeRivers();
  const vtkIdType ids[2] = { 0, 7 };
  broken->GetLines()->InsertNextCell(2, ids);
  cartogram->SetOverlayData(broken);
  ErrorTest(checks, cartogram).Expect("Cell 1 of the Overlay", __LINE__);
}

void addFieldNumber(vtkDataObject* data, const char* name)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->InsertNextValue(7.0);
  data->GetFieldData()->AddArray(array);
}

// Of a map that a cartogram made: its errors are those of no other output, which has its own data.
void checkFieldData(Checks& checks)
{
  auto map = makeMap(4);
  addFieldNumber(map, "AreaErrors");
  addFieldNumber(map, "Map");
  auto rivers = makeRivers();
  addFieldNumber(rivers, "Rivers");
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, rivers);
  addFieldNumber(blocks, "Blocks");
  auto cartogram = makeCartogram();
  cartogram->SetInputData(map);
  const auto has = [](vtkDataObject* data, const char* name) {
    return data->GetFieldData()->HasArray(name) != 0;
  };
  cartogram->Update();
  CHECK(checks, cartogram->GetOutputDataObject(2)->GetFieldData()->GetNumberOfArrays() == 0);
  cartogram->SetOverlayData(rivers);
  cartogram->Update();
  vtkDataArray* errors = cartogram->GetRegions()->GetFieldData()->GetArray("AreaErrors");
  CHECK(checks, errors->GetComponent(0, 0) != 7.0 && has(cartogram->GetRegions(), "Map"));
  CHECK(
    checks, has(cartogram->GetGraticule(), "Map") && !has(cartogram->GetGraticule(), "AreaErrors"));
  CHECK(checks, has(cartogram->GetOverlay(), "Rivers"));
  CHECK(checks, !has(cartogram->GetOverlay(), "AreaErrors"));
  cartogram->SetOverlayData(blocks);
  cartogram->Update();
  vtkDataObject* moved = cartogram->GetOutputDataObject(2);
  CHECK(checks, has(moved, "Blocks") && !has(moved, "AreaErrors"));
  CHECK(checks, has(vtkMultiBlockDataSet::SafeDownCast(moved)->GetBlock(0), "Rivers"));
}

void checkEmpty(Checks& checks)
{
  vtkNew<vtkPolyData> nothing; // no vtkPoints
  auto none = makePoints({});
  vtkNew<vtkMultiBlockDataSet> blocks;
  vtkNew<vtkMultiBlockDataSet> without;
  blocks->SetBlock(1, nothing);
  for (vtkDataObject* overlay :
    { static_cast<vtkDataObject*>(nothing), static_cast<vtkDataObject*>(none),
      static_cast<vtkDataObject*>(blocks), static_cast<vtkDataObject*>(without) })
  {
    auto cartogram = makeCartogram();
    Messages messages(cartogram);
    cartogram->SetOverlayData(overlay);
    cartogram->Update();
    CHECK(checks, messages.Errors.empty() && messages.Warnings.empty());
    CHECK(checks, cartogram->GetRegions()->GetNumberOfPolys() == 16);
    CHECK(checks, cartogram->GetOutputDataObject(2)->IsA(overlay->GetClassName()));
    CHECK(checks, isEmpty(cartogram->GetOutputDataObject(2)));
  }
}

// Beyond the raster points move as the nearest point of its border; off the plane they keep their
// distance.
void checkOutside(Checks& checks)
{
  auto inside = makePoints({ -0.4, 2, 0, 2, 4.4, 0, 1.5, 1.5, 0 }); // two on the border
  auto outside = makePoints({ -100.4, 2, 0, 2, 1e6, 0, 1.5, 1.5, 7 });
  const Values of = coordinates(inside);
  const Values from = coordinates(outside);
  const Values on = movedAlone(inside);
  const Values moved = movedAlone(outside);
  for (std::size_t i = 0; i < 9; ++i)
  {
    CHECK_NEAR(checks, moved[i] - from[i], on[i] - of[i], 1e-9 * (1.0 + std::abs(from[i])));
  }
  CHECK(checks, std::abs(moved[6] - 1.5) > 0.01 && moved[8] == 7.0);
}

} // namespace

int TestCartogramOverlay(int, char*[])
{
  return runChecks({ checkBlocks, checkOthers, checkFieldData, checkEmpty, checkOutside });
}

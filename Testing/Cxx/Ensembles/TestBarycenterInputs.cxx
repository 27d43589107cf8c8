// SPDX-License-Identifier: BSD-3-Clause
// The inputs of vtkTransportBarycenter: connections, blocks of composite data, both; and what is
// wrong with one of them.
#include "BlendTest.h"
#include "BlocksTest.h"

#include "vtkContourFilter.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkTable.h"
#include "vtkTrivialProducer.h"

#include <limits>

namespace
{

struct Inputs
{
  vtkSmartPointer<vtkImageData> A = makeDensity({ 24, 18, 1 }, false, smoothDensity(24, 18));
  vtkSmartPointer<vtkImageData> B = makeDensity({ 24, 18, 1 }, false, otherDensity(24, 18));
  vtkSmartPointer<vtkImageData> C = makeDensity({ 24, 18, 1 }, false, bumpy);
};

void setWeights(vtkTransportBarycenter* barycenter, const Values& weights)
{
  barycenter->SetNumberOfWeights(0);
  for (std::size_t i = 0; i < weights.size(); ++i)
  {
    barycenter->SetWeight(static_cast<int>(i), weights[i]);
  }
}

void checkComposite(Checks& checks)
{
  const Inputs in;
  const Values weights = { 1, 2, 3 };
  const Values expected = runDensity(makeBarycenter({ in.A, in.B, in.C }, weights));
  CHECK(checks, expected.size() == 24u * 18);

  // Blocks that are not there are no inputs.
  vtkNew<vtkMultiBlockDataSet> inner;
  inner->SetBlock(1, in.B);
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetNumberOfBlocks(6);
  blocks->SetBlock(0, in.A);
  blocks->SetBlock(2, inner);
  blocks->SetBlock(5, in.C);
  vtkNew<vtkTransportBarycenter> barycenter;
  setSimplest(barycenter);
  setWeights(barycenter, weights);
  barycenter->SetInputDataObject(blocks);
  CHECK(checks, runDensity(barycenter) == expected);
  const vtkMTimeType made = barycenter->GetDensity()->GetMTime();
  barycenter->Update();
  CHECK(checks, barycenter->GetDensity()->GetMTime() == made);
  CHECK(checks, vtkImageData::SafeDownCast(barycenter->GetOutputDataObject(0)) != nullptr);

  vtkNew<vtkPartitionedDataSetCollection> collection;
  collection->SetNumberOfPartitionedDataSets(4);
  collection->SetPartition(0, 0, in.A);
  collection->SetPartition(1, 0, in.B);
  collection->SetPartition(3, 0, in.C);
  barycenter->SetInputDataObject(collection);
  CHECK(checks, runDensity(barycenter) == expected);
  vtkNew<vtkPartitionedDataSet> partitions;
  partitions->SetPartition(0, in.A);
  partitions->SetPartition(1, in.B);
  partitions->SetPartition(2, in.C);
  barycenter->SetInputDataObject(partitions);
  CHECK(checks, runDensity(barycenter) == expected);

  // Both: blocks in the place of their connection.
  auto pair = makeBlocks({ in.A, in.B });
  barycenter->SetInputDataObject(pair);
  barycenter->AddInputDataObject(in.C);
  CHECK(checks, runDensity(barycenter) == expected);
  barycenter->RemoveAllInputs();
  barycenter->AddInputDataObject(in.C);
  barycenter->AddInputDataObject(pair);
  setWeights(barycenter, { 3, 1, 2 });
  CHECK_NEAR(checks, largestDifference(runDensity(barycenter), expected), 0.0, 1e-11);

  // Nothing at all is no error.
  Messages messages(barycenter);
  vtkNew<vtkMultiBlockDataSet> empty;
  empty->SetNumberOfBlocks(2);
  barycenter->SetInputDataObject(empty);
  barycenter->Update();
  CHECK(checks, messages.Errors.empty() && isEmpty(barycenter));
  vtkNew<vtkImageData> nothing;
  barycenter->SetInputDataObject(nothing);
  barycenter->Update();
  CHECK(checks, messages.Errors.empty() && isEmpty(barycenter));
  barycenter->SetInputDataObject(in.A);
  barycenter->AddInputDataObject(nothing);
  barycenter->Update();
  CHECK(checks, messages.Errors.empty() && isEmpty(barycenter));
}

// What the blocks of a composite input are is not known before the data; filters downstream must
// have the whole image nevertheless, at every update.
void checkDownstream(Checks& checks)
{
  const Inputs in;
  auto blocks = makeBlocks({ in.A, in.B });
  vtkNew<vtkTrivialProducer> producer;
  producer->SetOutput(blocks);
  vtkNew<vtkTransportBarycenter> barycenter;
  setSimplest(barycenter);
  barycenter->SetInputConnection(producer->GetOutputPort());
  Messages messages(barycenter);
  vtkNew<vtkContourFilter> contour;
  contour->SetInputConnection(barycenter->GetOutputPort());
  contour->SetValue(0, 1.0);
  vtkIdType last = 0;
  for (const double weight : { 0.0, 0.5, 2.0 })
  {
    setWeights(barycenter, { 1.0, weight });
    contour->Update();
    CHECK(checks, densityValues(barycenter).size() == 24u * 18);
    CHECK(checks, contour->GetOutput()->GetNumberOfPoints() > 0);
    CHECK(checks, contour->GetOutput()->GetNumberOfPoints() != last);
    last = contour->GetOutput()->GetNumberOfPoints();
  }
  // Blocks of another size.
  auto others = makeBlocks({ makeDensity({ 40, 30, 1 }, false, smoothDensity(40, 30)),
    makeDensity({ 40, 30, 1 }, false, otherDensity(40, 30)) });
  producer->SetOutput(others);
  contour->Update();
  CHECK(checks, densityValues(barycenter).size() == 40u * 30);
  CHECK(checks, contour->GetOutput()->GetBounds()[1] > 24.0);
  CHECK(checks, messages.Errors.empty());
}

void checkErrors(Checks& checks)
{
  const Inputs in;
  auto barycenter = makeBarycenter({ in.A, in.B, in.C });
  barycenter->Update();
  CHECK(checks, !isEmpty(barycenter));
  setWeights(barycenter, { 1, 2 });
  ErrorTest(checks, barycenter)
    .Expect(
      "The number of Weights is 2 and that of inputs 3; there must be one for each, or none for "
      "equal weights",
      __LINE__);
  setWeights(barycenter, { 1, 2, 3, 4 });
  ErrorTest(checks, barycenter).Expect("The number of Weights is 4 and that of inputs 3", __LINE__);
  setWeights(barycenter, { 1 });
  ErrorTest(checks, barycenter).Expect("The number of Weights is 1 and that of inputs 3", __LINE__);
  setWeights(barycenter, { 1, -2, 3 });
  ErrorTest(checks, barycenter)
    .Expect("Weight 1 of the Weights is -2; weights must be finite and at least 0", __LINE__);
  setWeights(barycenter, { 1, 2, std::numeric_limits<double>::quiet_NaN() });
  ErrorTest(checks, barycenter).Expect("Weight 2 of the Weights is nan", __LINE__);
  setWeights(barycenter, { HUGE_VAL, 2, 1 });
  ErrorTest(checks, barycenter).Expect("Weight 0 of the Weights is inf", __LINE__);
  setWeights(barycenter, { 0, 0, 0 });
  ErrorTest(checks, barycenter).Expect("All Weights are 0; at least one must be above 0", __LINE__);
  setWeights(barycenter, {});

  // Which input it is, by its number.
  const auto nothing = [](vtkIdType) { return 0.0; };
  ErrorTest(checks, makeBarycenter({ in.A, makeDensity({ 24, 18, 1 }, false, nothing), in.C }))
    .Expect("Input 2 of 3: The density array 'Density' has a total mass of zero", __LINE__);
  ErrorTest(checks, makeBarycenter({ in.A, in.C, makeDensity({ 9, 8, 7 }, false, bumpy) }))
    .Expect("Input 1 of 3 has the axes x and y, Input 3 of 3 has the axes x and y and z", __LINE__);
  auto renamed = makeDensity({ 24, 18, 1 }, false, bumpy);
  renamed->GetPointData()->GetScalars()->SetName("Other");
  barycenter = makeBarycenter({ renamed, in.A });
  barycenter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Density");
  ErrorTest(checks, barycenter)
    .Expect("Input 1 of 2: The input image has no density array 'Density'; it has Other (point)",
      __LINE__);
  barycenter = makeBarycenter({ in.A, in.B, in.C });
  barycenter->SetMassMode(7);
  ErrorTest(checks, barycenter).Expect("MassMode is 7; it must be 0 (Linear)", __LINE__);

  // A block that is no data set is passed over; it is an error if all are such.
  vtkNew<vtkTable> table;
  auto blocks = makeBlocks({ table, table });
  barycenter = vtkSmartPointer<vtkTransportBarycenter>::New();
  setSimplest(barycenter);
  barycenter->SetInputDataObject(blocks);
  ErrorTest(checks, barycenter)
    .Expect("The inputs have no image, mesh or grid, but 2 blocks of another type (the first a "
            "vtkTable, block 1 of the input)",
      __LINE__);
  blocks->SetBlock(1, in.A);
  blocks->SetBlock(2, in.B);
  blocks->Modified();
  Messages messages(barycenter);
  CHECK(checks, runDensity(barycenter) == runDensity(makeBarycenter({ in.A, in.B })));
  CHECK(checks, messages.Errors.empty());
  CHECK(checks,
    messages.Warnings.size() == 1 &&
      contains(messages.Warnings[0],
        "1 block of the inputs (the first a vtkTable, block 1 of the input) is no data set"));
}

} // namespace

int TestBarycenterInputs(int, char*[])
{
  return runChecks({ checkComposite, checkDownstream, checkErrors });
}

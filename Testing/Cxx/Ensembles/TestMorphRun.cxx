// SPDX-License-Identifier: BSD-3-Clause
// How a morph runs: threads, progress, abort in every stage, pieces, and no more than is asked for.
#include "BlendTest.h"
#include "BlocksTest.h"
#include "ProgressTest.h"
#include "ThreadsTest.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkStreamingDemandDrivenPipeline.h"

namespace
{

// All that comes out.
Values allValues(vtkTransportBlend* blend)
{
  Values all = densityValues(blend);
  for (const char* name : { "SourcePosition", "TargetPosition", "Mass" })
  {
    const Values values = particleValues(blend, name);
    all.insert(all.end(), values.begin(), values.end());
  }
  const Values places = particlePlaces(blend);
  all.insert(all.end(), places.begin(), places.end());
  all.push_back(fieldValue(blend->GetDensity(), "TotalMass"));
  return all;
}

void checkThreads(Checks& checks, vtkImageData* source, vtkImageData* target, int perCell)
{
  auto morph = makeMorph(source, target, 0.375);
  morph->SetParticlesPerCell(perCell);
  morph->SetNumberOfSteps(8);
  const auto run = [&](int threading) {
    morph->SetThreading(threading);
    forgetTables(morph, source); // the maps, too
    forgetTables(morph, target);
    std::vector<Values> ofKernels;
    for (int kernel = 0; kernel < 4; ++kernel)
    {
      morph->SetKernel(kernel);
      morph->Update();
      ofKernels.push_back(allValues(morph));
    }
    return ofKernels;
  };
  CHECK(checks, expectSameBits(checks, run, __LINE__)[3].size() > 1000);
}

void checkThreads(Checks& checks)
{
  auto target = makeDensity({ 80, 120, 1 }, false, bumpy);
  target->SetOrigin(40.0, 20.0, 0.0);
  checkThreads(checks, makeDensity({ 131, 97, 1 }, true, bumpy), target, 3);
  checkThreads(
    checks, makeDensity({ 20, 21, 29 }, true, bumpy), makeDensity({ 20, 21, 29 }, true, bumpy), 2);
  checkThreads(
    checks, makeDensity({ 5000, 1, 1 }, true, bumpy), makeDensity({ 4000, 1, 1 }, true, bumpy), 4);
}

void expectProgress(Checks& checks, vtkTransportBlend* blend, std::size_t calls, int line)
{
  ProgressTest test(blend);
  blend->Update();
  test.ExpectRising(checks, calls, line);
}

void checkAbort(Checks& checks)
{
  const Counts size = { 90, 80, 100 };
  const auto ramp = [](vtkIdType i) { return static_cast<double>(1 + i % 100); };
  auto source = makeDensity(size, true, ramp);
  auto target = makeDensity(size, true, bumpy);
  auto morph = makeMorph(source, target);
  Messages messages(morph);
  morph->SetNumberOfSteps(8);
  const auto outdate = [&]() {
    changeDensity(source);
    changeDensity(target);
  };
  // In tables and map of either, between them, and after.
  for (const double from : { 0.0001, 0.02, 0.25, 0.51, 0.75, 0.97, 0.995 })
  {
    checkAbort(checks, morph, from, outdate, __LINE__);
  }
  for (const double from : { 0.1, 0.55 })
  {
    checkAbort(checks, morph, from, outdate, __LINE__, 30);
  }
  outdate();
  expectProgress(checks, morph, 20, __LINE__);
  CHECK(checks, densityValues(morph).size() == 90u * 80 * 100);

  // With the maps kept: means, particles, splat.
  const auto turn = [&]() { morph->SetParameter(1.0 - morph->GetParameter() + 0.001); };
  for (const double from : { 0.05, 0.3, 0.6, 0.95 })
  {
    checkAbort(checks, morph, from, turn, __LINE__);
  }
  turn();
  expectProgress(checks, morph, 5, __LINE__);

  // One of two maps is new.
  changeDensity(target);
  expectProgress(checks, morph, 10, __LINE__);
  // Only the images are new: a look at the values.
  source->Modified();
  target->Modified();
  expectProgress(checks, morph, 5, __LINE__);
  CHECK(checks, messages.Errors.empty());
}

void checkAgain(Checks& checks)
{
  auto morph =
    makeMorph(makeDensity({ 12, 10, 1 }, true, bumpy), makeDensity({ 12, 10, 1 }, true, bumpy));
  morph->Update();
  const vtkMTimeType density = morph->GetDensity()->GetMTime();
  const vtkMTimeType particles = morph->GetParticles()->GetMTime();
  for (const int port : { 0, 1, 0 })
  {
    morph->Update(port);
    CHECK(checks, morph->GetDensity()->GetMTime() == density);
    CHECK(checks, morph->GetParticles()->GetMTime() == particles);
  }
  morph->SetParameter(morph->GetParameter());
  morph->Update();
  CHECK(checks, morph->GetDensity()->GetMTime() == density);
}

// All is in the first piece of what is asked for, of either output.
void checkPieces(Checks& checks)
{
  auto morph =
    makeMorph(makeDensity({ 12, 10, 1 }, true, bumpy), makeDensity({ 12, 10, 1 }, true, bumpy));
  morph->Update();
  const Values whole = densityValues(morph);
  morph->UpdatePiece(0, 2, 1);
  CHECK(checks, whole.size() == 120 && densityValues(morph) == whole);
  morph->UpdatePiece(1, 2, 0);
  CHECK(checks, morph->GetDensity()->GetNumberOfPoints() == 0);

  const auto ask = [&](int port, int piece) {
    vtkNew<vtkInformationVector> requests;
    requests->SetNumberOfInformationObjects(2);
    vtkInformation* request = requests->GetInformationObject(port);
    request->Set(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER(), piece);
    request->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES(), 2);
    request->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
    morph->Update(port, requests);
  };
  ask(0, 0);
  CHECK(checks, densityValues(morph) == whole);
  ask(1, 1);
  CHECK(checks, morph->GetParticles()->GetNumberOfPoints() == 0);
  ask(0, 0);
  CHECK(checks, densityValues(morph) == whole);
  // The first piece of one output is there whatever was asked of the other.
  ask(0, 1);
  CHECK(checks, isEmpty(morph));
  ask(1, 0);
  CHECK(checks, morph->GetParticles()->GetNumberOfPoints() == 120);
  ask(0, 0);
  CHECK(checks, densityValues(morph) == whole);
}

// The blocks of a composite input are one density.
void checkComposite(Checks& checks)
{
  auto source = makeDensity({ 12, 10, 1 }, true, bumpy);
  auto target = makeDensity({ 12, 10, 1 }, true, otherDensity(12, 10));
  const Values expected = runDensity(makeMorph(source, target));
  auto morph = makeMorph(source, target);
  morph->SetInputData(makeTiles(source, 5));
  CHECK(checks, !expected.empty() && runDensity(morph) == expected);
  morph->SetInputData(source);
  morph->SetTargetData(makeTiles(target, 3));
  CHECK(checks, runDensity(morph) == expected);
}

} // namespace

int TestMorphRun(int, char*[])
{
  return runChecks({ checkThreads, checkAbort, checkAgain, checkPieces, checkComposite });
}

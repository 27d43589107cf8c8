// SPDX-License-Identifier: BSD-3-Clause
// What every test of a VTK class needs: checks, and the errors and warnings of algorithms.
#ifndef Checks_h
#define Checks_h

#include "vtkAlgorithm.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkDataObject.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <cmath>
#include <cstdlib>
#include <functional>
#include <initializer_list>
#include <iostream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

// Counts and prints the conditions that do not hold, and goes on.
class Checks
{
public:
  void That(bool holds, const char* what, int line, const std::string& detail = "")
  {
    if (!holds)
    {
      std::cout << "line " << line << ": " << what << " does not hold"
                << (detail.empty() ? "" : ": ") << detail << "\n";
      ++this->Failures;
    }
  }
  void Near(double a, double b, double tolerance, const char* what, int line)
  {
    std::ostringstream detail;
    detail << a << " and " << b << ", more than " << tolerance << " apart";
    this->That(std::abs(a - b) <= tolerance, what, line, detail.str());
  }
  int Result() const { return this->Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE; }

private:
  int Failures = 0;
};

// Runs all checks of a test. Returns the exit code of its main function.
inline int runChecks(std::initializer_list<void (*)(Checks&)> all)
{
  Checks checks;
  for (const auto& check : all)
  {
    check(checks);
  }
  return checks.Result();
}

// Changes and their names.
using Changes = std::initializer_list<std::pair<const char*, std::function<void()>>>;

// Checks that happens() is `expected` after each of the changes.
inline void expectAfterEach(
  Checks& checks, const std::function<bool()>& happens, bool expected, Changes changes, int line)
{
  for (const auto& [name, change] : changes)
  {
    change();
    checks.That(happens() == expected, name, line);
  }
}

#define CHECK(checks, condition) (checks).That((condition), #condition, __LINE__)
#define CHECK_NEAR(checks, a, b, tolerance)                                                        \
  (checks).Near((a), (b), (tolerance), #a " == " #b, __LINE__)

inline bool contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

// Collects the errors and warnings of an algorithm. Neither they nor the errors of its executive
// are printed.
class Messages
{
public:
  explicit Messages(vtkAlgorithm* algorithm)
    : Algorithm(algorithm)
  {
    this->Observer->SetClientData(this);
    this->Observer->SetCallback([](vtkObject*, unsigned long event, void* self, void* text) {
      auto* messages = static_cast<Messages*>(self);
      (event == vtkCommand::ErrorEvent ? messages->Errors : messages->Warnings)
        .push_back(static_cast<const char*>(text));
    });
    algorithm->AddObserver(vtkCommand::ErrorEvent, this->Observer);
    algorithm->AddObserver(vtkCommand::WarningEvent, this->Observer);
    this->ExecutiveObserver->SetCallback([](vtkObject*, unsigned long, void*, void*) {});
    algorithm->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, this->ExecutiveObserver);
  }

  ~Messages()
  {
    this->Algorithm->RemoveObserver(this->Observer);
    this->Algorithm->GetExecutive()->RemoveObserver(this->ExecutiveObserver);
  }
  Messages(const Messages&) = delete;
  Messages& operator=(const Messages&) = delete;

  void Clear()
  {
    this->Errors.clear();
    this->Warnings.clear();
  }

  // Whether there is one error, which contains the part.
  bool IsOneError(const std::string& part) const
  {
    return this->Errors.size() == 1 && contains(this->Errors[0], part);
  }

  std::vector<std::string> Errors;
  std::vector<std::string> Warnings;

private:
  vtkSmartPointer<vtkAlgorithm> Algorithm;
  vtkNew<vtkCallbackCommand> Observer;
  vtkNew<vtkCallbackCommand> ExecutiveObserver;
};

// Whether a data object has no points, cells and rows, and no arrays of them.
inline bool isEmpty(vtkDataObject* data)
{
  bool empty = data != nullptr;
  for (const int kind : { vtkDataObject::POINT, vtkDataObject::CELL, vtkDataObject::ROW })
  {
    vtkFieldData* arrays = empty ? data->GetAttributesAsFieldData(kind) : nullptr;
    empty = empty && data->GetNumberOfElements(kind) == 0 &&
      (!arrays || arrays->GetNumberOfArrays() == 0);
  }
  return empty;
}

// Whether all outputs are.
inline bool isEmpty(vtkAlgorithm* algorithm)
{
  bool empty = true;
  for (int port = 0; port < algorithm->GetNumberOfOutputPorts(); ++port)
  {
    empty = empty && isEmpty(algorithm->GetOutputDataObject(port));
  }
  return empty;
}

// Checks that of two requested pieces the first has everything.
inline void expectOnePiece(Checks& checks, vtkAlgorithm* algorithm, int line)
{
  algorithm->UpdatePiece(1, 2, 0);
  checks.That(isEmpty(algorithm), "an empty second piece", line);
  algorithm->UpdatePiece(0, 2, 0);
  checks.That(!isEmpty(algorithm), "a first piece", line);
}

// Updates an algorithm and checks that it reports one error and has empty outputs.
class ErrorTest
{
public:
  ErrorTest(Checks& checks, vtkAlgorithm* algorithm)
    : Check(checks)
    , Algorithm(algorithm)
    , Reported(algorithm)
  {
  }

  // The error has all the parts.
  void Expect(std::initializer_list<std::string> parts, int line)
  {
    this->Update();
    const std::string found = this->Reported.Errors.empty() ? "no error" : this->Reported.Errors[0];
    this->Check.That(this->Reported.Errors.size() == 1, "one error", line, found);
    for (const std::string& part : parts)
    {
      this->Check.That(contains(found, part), part.c_str(), line, found);
    }
    this->Check.That(isEmpty(this->Algorithm), "empty output", line);
    for (int port = 0; port < this->Algorithm->GetNumberOfOutputPorts(); ++port)
    {
      vtkDataObject* output = this->Algorithm->GetOutputDataObject(port);
      this->Check.That(
        output && output->GetFieldData()->GetNumberOfArrays() == 0, "no field data", line);
    }
  }
  void Expect(const std::string& part, int line) { this->Expect({ part }, line); }

  void ExpectNone(int line)
  {
    this->Update();
    this->Check.That(this->Reported.Errors.empty(), "no error", line,
      this->Reported.Errors.empty() ? "" : this->Reported.Errors[0]);
  }

private:
  void Update()
  {
    this->Reported.Clear();
    this->Algorithm->Update();
  }

  Checks& Check;
  vtkAlgorithm* Algorithm;
  Messages Reported;
};

#endif

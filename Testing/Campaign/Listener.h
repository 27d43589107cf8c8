// SPDX-License-Identifier: BSD-3-Clause
// Records the messages and the progress of a filter during an update, and may abort it.
#ifndef Campaign_Listener_h
#define Campaign_Listener_h

#include "vtkAlgorithm.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOutputWindow.h"
#include "vtkSmartPointer.h"

#include <string>
#include <vector>

namespace Campaign
{

// Collects the text that would be printed.
class SilentWindow : public vtkOutputWindow
{
public:
  static SilentWindow* New();
  vtkTypeMacro(SilentWindow, vtkOutputWindow);

  void DisplayText(const char*) override {}
  void DisplayWarningText(const char*) override {}
  void DisplayGenericWarningText(const char*) override {}
  void DisplayDebugText(const char*) override {}
  void DisplayErrorText(const char* text) override { this->Errors.emplace_back(text); }

  std::vector<std::string> Errors;

protected:
  SilentWindow() = default;
};

class Listener
{
public:
  Listener(vtkAlgorithm* filter, int abortAt)
    : Filter(filter)
    , AbortAt(abortAt)
  {
    vtkOutputWindow::SetInstance(this->Window);
    this->Observer->SetClientData(this);
    this->Observer->SetCallback([](vtkObject*, unsigned long event, void* self, void* data) {
      static_cast<Listener*>(self)->Record(event, data);
    });
    for (const unsigned long event :
      { vtkCommand::ErrorEvent, vtkCommand::WarningEvent, vtkCommand::ProgressEvent })
    {
      filter->AddObserver(event, this->Observer);
    }
  }
  ~Listener() { this->Filter->RemoveObserver(this->Observer); }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  // What was printed, but for the executives' messages of a failure and of inputs. (The filter's
  // own messages go to its observer.)
  std::vector<std::string> Others() const
  {
    std::vector<std::string> others;
    for (const std::string& text : this->Window->Errors)
    {
      const bool usual = isPartOf("returned failure for request", text) ||
        isPartOf("is not optional", text) || isPartOf("is required.", text);
      if (!usual)
      {
        others.push_back(text);
      }
    }
    return others;
  }

  std::vector<std::string> Errors;
  std::vector<std::string> Warnings;
  std::vector<double> Progress;
  bool HasAborted = false;

private:
  static bool isPartOf(const char* part, const std::string& text)
  {
    return text.find(part) != std::string::npos;
  }

  void Record(unsigned long event, void* data)
  {
    if (event == vtkCommand::ProgressEvent)
    {
      this->Progress.push_back(*static_cast<double*>(data));
      if (static_cast<int>(this->Progress.size()) - 1 == this->AbortAt)
      {
        this->HasAborted = true;
        this->Filter->SetAbortExecute(1);
      }
      return;
    }
    (event == vtkCommand::ErrorEvent ? this->Errors : this->Warnings)
      .emplace_back(static_cast<const char*>(data));
  }

  vtkSmartPointer<vtkAlgorithm> Filter;
  int AbortAt;
  vtkNew<SilentWindow> Window;
  vtkNew<vtkCallbackCommand> Observer;
};

} // namespace Campaign

#endif

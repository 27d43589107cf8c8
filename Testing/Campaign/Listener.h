// SPDX-License-Identifier: BSD-3-Clause
// Hears a filter during an update: messages and progress; and may abort it.
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

// Takes in what would be printed.
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
    this->Ear->SetClientData(this);
    this->Ear->SetCallback([](vtkObject*, unsigned long event, void* self, void* data) {
      static_cast<Listener*>(self)->Hear(event, data);
    });
    for (const unsigned long event :
      { vtkCommand::ErrorEvent, vtkCommand::WarningEvent, vtkCommand::ProgressEvent })
    {
      filter->AddObserver(event, this->Ear);
    }
  }
  ~Listener() { this->Filter->RemoveObserver(this->Ear); }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  // What was printed, but for what executives say of a failure and of inputs. (What the filter says
  // goes to its observer.)
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
  std::vector<double> Heard;
  bool HasAborted = false;

private:
  static bool isPartOf(const char* part, const std::string& text)
  {
    return text.find(part) != std::string::npos;
  }

  void Hear(unsigned long event, void* data)
  {
    if (event == vtkCommand::ProgressEvent)
    {
      this->Heard.push_back(*static_cast<double*>(data));
      if (static_cast<int>(this->Heard.size()) - 1 == this->AbortAt)
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
  vtkNew<vtkCallbackCommand> Ear;
};

} // namespace Campaign

#endif

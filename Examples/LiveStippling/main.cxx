// SPDX-License-Identifier: BSD-3-Clause
// Stipples what one paints, while one paints it: see README.md.
#include "Drive.h"
#include "PaintStyle.h"
#include "PointSlider.h"
#include "StippleView.h"
#include "Stippling.h"

#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>

#include <cstdlib>
#include <iostream>
#include <stdexcept>
#include <string>

namespace
{

const char* const usage =
  "usage: LiveStippling [IMAGE] [--points N] [--side CELLS] [--device NAME] [--drive UPDATES]\n"
  "                     [--picture FILE]\n"
  "  IMAGE           any picture that VTK reads; dark ink is mass\n"
  "  --points N      1 to 200000, 16384 by default\n"
  "  --side CELLS    of the density along its longer side: 64 to 4096, 1024 by default\n"
  "  --device NAME   transport on an OpenCL device whose name contains this, or \"any\"\n"
  "  --drive UPDATES paints by itself, prints figures and ends: 5 or more\n"
  "  --picture FILE  a PNG of the window at the end\n";

struct Arguments
{
  Stippling::Options Options;
  std::string Image;
  std::string Picture;
  int Drive = 0;
};

int numberOf(const std::string& option, const std::string& text, int least, int most)
{
  std::size_t length = 0;
  long long number = 0;
  try
  {
    number = std::stoll(text, &length);
  }
  catch (const std::exception&)
  {
    length = 0;
  }
  if (length == 0 || length != text.size() || number < least || number > most)
  {
    throw std::invalid_argument(option + " is " + text + "; it must be from " +
      std::to_string(least) + " to " + std::to_string(most));
  }
  return static_cast<int>(number);
}

Arguments parse(int argc, char* argv[])
{
  Arguments arguments;
  for (int i = 1; i < argc; ++i)
  {
    const std::string name = argv[i];
    const auto value = [&]() -> std::string {
      if (i + 1 == argc)
      {
        throw std::invalid_argument(name + " needs a value");
      }
      return argv[++i];
    };
    if (name == "--points")
    {
      arguments.Options.NumberOfPoints = numberOf(name, value(), 1, LiveTransport::MostPoints);
    }
    else if (name == "--side")
    {
      arguments.Options.Side = numberOf(name, value(), 64, 4096);
    }
    else if (name == "--device")
    {
      arguments.Options.Device = value();
    }
    else if (name == "--drive")
    {
      arguments.Drive = numberOf(name, value(), 5, 1000000);
    }
    else if (name == "--picture")
    {
      arguments.Picture = value();
    }
    else if (name.rfind('-', 0) == 0 || !arguments.Image.empty())
    {
      throw std::invalid_argument("unknown argument " + name);
    }
    else
    {
      arguments.Image = name;
    }
  }
  return arguments;
}

int run(const Arguments& arguments)
{
  Stippling stippling(arguments.Options);
  if (!arguments.Image.empty() && !stippling.Open(arguments.Image))
  {
    std::cerr << stippling.GetMessage() << "\n";
    if (arguments.Drive > 0)
    {
      return EXIT_FAILURE;
    }
  }
  stippling.Update();
  if (!arguments.Options.Device.empty() && !stippling.GetMessage().empty())
  {
    std::cerr << stippling.GetMessage() << "\n";
  }
  vtkNew<vtkRenderWindow> window;
  window->SetSize(900, 900);
  window->SetWindowName("Live stippling");
  StippleView view(stippling, window);
  vtkNew<vtkRenderWindowInteractor> interactor;
  interactor->SetRenderWindow(window);
  view.Render();
  interactor->Initialize();
  PointSlider slider(stippling, interactor);
  vtkNew<PaintStyle> style;
  style->Connect(&stippling, &view, &slider);
  interactor->SetInteractorStyle(style);
  if (arguments.Drive > 0)
  {
    drive(stippling, interactor, arguments.Drive, std::cout);
  }
  else
  {
    interactor->CreateRepeatingTimer(5); // milliseconds: an update takes longer
    interactor->Start();
  }
  if (!arguments.Picture.empty() && !savePicture(window, arguments.Picture))
  {
    std::cerr << "Could not write " << arguments.Picture << "\n";
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}

} // namespace

int main(int argc, char* argv[])
{
  if (argc == 2 && std::string(argv[1]) == "--help")
  {
    std::cout << usage;
    return EXIT_SUCCESS;
  }
  Arguments arguments;
  try
  {
    arguments = parse(argc, argv);
  }
  catch (const std::invalid_argument& wrong)
  {
    std::cerr << wrong.what() << "\n" << usage;
    return 2;
  }
  return run(arguments);
}

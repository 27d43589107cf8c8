// SPDX-License-Identifier: BSD-3-Clause
// Reads meshes of the Object File Format as text, which VTK reads from 9.4 on only.
#ifndef MeshFile_h
#define MeshFile_h

#include "vtkCellArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

// Null if the file is not a mesh of polygons.
inline vtkSmartPointer<vtkPolyData> readMesh(const std::string& path)
{
  std::ifstream file(path);
  std::stringstream words;
  for (std::string line; std::getline(file, line);)
  {
    words << line.substr(0, line.find('#')) << "\n";
  }
  std::string magic;
  vtkIdType numberOfPoints = 0;
  vtkIdType numberOfPolygons = 0;
  vtkIdType numberOfEdges = 0;
  words >> magic >> numberOfPoints >> numberOfPolygons >> numberOfEdges;
  if (magic != "OFF")
  {
    return nullptr;
  }
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (vtkIdType i = 0; i < numberOfPoints && words; ++i)
  {
    double x[3];
    words >> x[0] >> x[1] >> x[2];
    points->InsertNextPoint(x);
  }
  vtkNew<vtkCellArray> polygons;
  std::vector<vtkIdType> corners;
  for (vtkIdType i = 0; i < numberOfPolygons && words; ++i)
  {
    std::size_t count = 0;
    words >> count;
    corners.assign(count, 0);
    for (vtkIdType& corner : corners)
    {
      words >> corner;
    }
    polygons->InsertNextCell(static_cast<vtkIdType>(count), corners.data());
  }
  if (!words)
  {
    return nullptr;
  }
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(points);
  mesh->SetPolys(polygons);
  return mesh;
}

#endif

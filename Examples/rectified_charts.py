# SPDX-License-Identifier: BSD-3-Clause
"""Line charts as ParaView's line chart view draws them, as pictures."""
import numpy as np
import rectified_figures as figures
import vtkmodules.vtkRenderingContextOpenGL2  # noqa: F401, the chart's view needs it
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkChartsCore import vtkAxis, vtkChart, vtkChartXY
from vtkmodules.vtkCommonDataModel import vtkTable
from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter
from vtkmodules.vtkViewsContext2D import vtkContextView

FONT = 15  # pixels


def column(name, values):
    array = numpy_to_vtk(np.asarray(values, float), deep=1)
    array.SetName(name)
    return array


def add_line(chart, name, x, y, colour, marks):
    """Adds a line to a chart, with dots at some of its points."""
    for kind, chosen, label in ((vtkChart.LINE, slice(None), name), (vtkChart.POINTS, marks, "")):
        table = vtkTable()
        table.AddColumn(column("x", np.asarray(x)[chosen]))
        table.AddColumn(column("y", np.asarray(y)[chosen]))
        plot = chart.AddPlot(kind)
        plot.SetInputData(table, 0, 1)
        plot.SetLabel(label)
        plot.SetColor(*(round(255 * part) for part in colour), 255)
        plot.SetWidth(2.5 if kind == vtkChart.LINE else 1)
        if kind == vtkChart.POINTS:
            plot.SetMarkerStyle(4)  # circles
            plot.SetMarkerSize(9)


def set_axis(axis, title, low, high, logarithmic=False):
    axis.SetTitle(title)
    axis.SetBehavior(vtkAxis.FIXED)
    axis.SetUnscaledRange(low, high)
    axis.SetLogScale(logarithmic)
    axis.SetGridVisible(True)
    axis.GetGridPen().SetColor(225, 225, 225)
    for style in axis.GetTitleProperties(), axis.GetLabelProperties():
        style.SetFontSize(FONT)
        style.SetBold(0)


def chart(lines, titles, ranges, size):
    """The picture of lines of a name, x, y, a colour and the points that have dots, over axes with
    titles and with ranges; the axis of y is logarithmic."""
    drawn = vtkChartXY()
    for line in lines:
        add_line(drawn, *line)
    set_axis(drawn.GetAxis(vtkAxis.BOTTOM), titles[0], *ranges[0])
    set_axis(drawn.GetAxis(vtkAxis.LEFT), titles[1], *ranges[1], logarithmic=True)
    drawn.SetShowLegend(True)
    drawn.GetLegend().SetLabelSize(FONT)
    view = vtkContextView()
    window = view.GetRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(*size)
    view.GetRenderer().SetBackground(1, 1, 1)
    view.GetScene().AddItem(drawn)
    window.Render()
    taken = vtkWindowToImageFilter()
    taken.SetInput(window)
    taken.ReadFrontBufferOff()
    taken.Update()
    return figures.values_of(taken.GetOutput())[..., :3].copy()

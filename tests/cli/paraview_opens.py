# What ParaView sees of a volume or a series of them, as JSON: times, and of each block the cells, bounds and arrays with their ranges.
import json
import sys

from paraview import servermanager
from paraview.simple import OpenDataFile, UpdatePipeline

source = OpenDataFile(sys.argv[1])
UpdatePipeline(proxy=source)
data = servermanager.Fetch(source)
blocks = []
for i in range(data.GetNumberOfBlocks()):
    image = data.GetBlock(i)
    while image.IsA("vtkMultiBlockDataSet"):
        image = image.GetBlock(0)
    cells = image.GetCellData()
    arrays = {cells.GetArrayName(k): cells.GetArray(k).GetRange(0) for k in range(cells.GetNumberOfArrays())}
    blocks.append({"cells": image.GetNumberOfCells(), "bounds": image.GetBounds(), "arrays": arrays,
                   "about": image.GetFieldData().GetAbstractArray("about").GetValue(0)})
times = source.TimestepValues if hasattr(source, "TimestepValues") else []
print(json.dumps({"blocks": blocks, "times": [times] if isinstance(times, float) else list(times)}))

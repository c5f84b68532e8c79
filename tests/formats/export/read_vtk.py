"""Reads an export with VTK itself and prints what it found as JSON: read_vtk.py FOLDER"""
import json
import pathlib
import sys
import xml.etree.ElementTree as xml

import vtk  # Debian: python3-vtk9


def read(path):
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    data = reader.GetOutput()
    arrays = {}
    for kind, fields in (("cell", data.GetCellData()), ("point", data.GetPointData())):
        for k in range(fields.GetNumberOfArrays()):
            a = fields.GetArray(k)
            arrays[f"{kind}.{a.GetName()}"] = [list(a.GetTuple(t)) for t in range(a.GetNumberOfTuples())]
    mass = None
    if data.GetNumberOfPolys() > 0:
        triangles = vtk.vtkTriangleFilter()
        triangles.SetInputData(data)
        properties = vtk.vtkMassProperties()
        properties.SetInputConnection(triangles.GetOutputPort())
        mass = properties.GetVolume()
    return {"points": data.GetNumberOfPoints(), "polys": data.GetNumberOfPolys(), "verts": data.GetNumberOfVerts(),
            "arrays": arrays, "volume": mass, "bounds": list(data.GetBounds())}


folder = pathlib.Path(sys.argv[1])
found = {}
for series in ("blocks", "contacts"):
    sets = xml.parse(folder / f"{series}.pvd").getroot().iter("DataSet")
    found[series] = [{"time": float(s.get("timestep")), **read(folder / s.get("file"))} for s in sets]
print(json.dumps(found))

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files of the pictures of render.py: PNG, PDF and SVG."""
import base64
import ctypes
import functools
import pathlib
import zlib

from render_data import fail, vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import (vtkRenderWindow,
                                         vtkWindowToImageFilter)


@functools.lru_cache
def need_display():
    """End with a sentence where VTK would abort, as it finds no display.

    The connection stays: when its last one ends, Xvfb starts anew, and takes no
    other for a while."""
    try:
        library = ctypes.CDLL("libX11.so.6")
    except OSError:
        return None  # not a system on which VTK asks for it
    library.XOpenDisplay.restype = ctypes.c_void_p
    display = library.XOpenDisplay(None)
    if not display:
        fail("there is no display to draw on; put xvfb-run -a before the "
             "command, which the packages xvfb and xauth bring.")
    return display


def save(renderers, size, path, dpi):
    """Draw layers one upon the other and write them to a PNG, PDF or SVG file.

    All are of pixels, PDF and SVG of the size at which they have their dpi."""
    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetAlphaBitPlanes(True)
    window.SetMultiSamples(0 if renderers[1].GetUseDepthPeeling() else 4)
    window.SetNumberOfLayers(len(renderers))
    window.SetSize(*size)
    for renderer in renderers:
        window.AddRenderer(renderer)
    window.Render()
    image, writer = vtkWindowToImageFilter(), vtkPNGWriter()
    image.SetInput(window)
    writer.SetInputConnection(image.GetOutputPort())
    writer.SetCompressionLevel(9)
    writer.WriteToMemoryOn()
    writer.Write()
    data = vtk_to_numpy(writer.GetResult()).tobytes()
    path = pathlib.Path(path)
    if path.suffix == ".svg":
        data = as_svg(data, size, dpi)
    elif path.suffix == ".pdf":
        pixels = vtk_to_numpy(
            image.GetOutput().GetPointData().GetScalars())[:, :3]
        data = as_pdf(pixels.reshape(size[1], size[0], 3)[::-1], dpi)
    try:
        path.write_bytes(data)
    except OSError as error:
        fail(f"the picture '{path}' cannot be written ({error.strerror}); "
             "check its folder and free space.")


def as_svg(png, size, dpi):
    """An SVG file that holds a picture."""
    wide, high = (f"{n / dpi:.6g}in" for n in size)
    address = base64.b64encode(png).decode()
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{wide}" '
            f'height="{high}" viewBox="0 0 {size[0]} {size[1]}"><image '
            f'width="{size[0]}" height="{size[1]}" '
            f'href="data:image/png;base64,{address}"/></svg>\n').encode()


def as_pdf(pixels, dpi):
    """A PDF file of one page that holds a picture."""
    high, wide = pixels.shape[:2]
    box = f"{72. * wide / dpi:.6g} 0 0 {72. * high / dpi:.6g}"
    draw = f"q {box} 0 0 cm /P Do Q".encode()
    data = zlib.compress(pixels.tobytes(), 9)
    page = box.replace(" 0 0 ", " ")
    objects = [
        b"<</Type/Catalog/Pages 2 0 R>>",
        b"<</Type/Pages/Kids[3 0 R]/Count 1>>",
        f"<</Type/Page/Parent 2 0 R/MediaBox[0 0 {page}]/Contents 4 0 R"
        "/Resources<</XObject<</P 5 0 R>>>>>>".encode(),
        b"<</Length %d>>\nstream\n%s\nendstream" % (len(draw), draw),
        f"<</Type/XObject/Subtype/Image/Width {wide}/Height {high}"
        "/ColorSpace/DeviceRGB/BitsPerComponent 8/Filter/FlateDecode"
        f"/Length {len(data)}>>\nstream\n".encode() + data + b"\nendstream"]
    text, places = b"%PDF-1.4\n", []
    for n, one in enumerate(objects, 1):
        places.append(len(text))
        text += b"%d 0 obj\n%s\nendobj\n" % (n, one)
    table = "".join(f"{place:010d} 00000 n \n" for place in places)
    return text + (f"xref\n0 6\n0000000000 65535 f \n{table}trailer\n"
                   f"<</Size 6/Root 1 0 R>>\nstartxref\n{len(text)}\n"
                   "%%EOF\n").encode()

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the volumes of this folder by the tools of others, as tests read them (unit/input/volume).

Debian: apt-get install python3-numpy python3-nibabel python3-pil teem-apps imagemagick. All of them hold
the same 4 x 3 x 5 numbers, which the tests know by a rule. Other versions of these tools may write other bytes.
"""
import pathlib
import subprocess

import nibabel
import numpy
from PIL import Image


def volume(dtype):
    x, y, z = numpy.meshgrid(range(4), range(3), range(5), indexing="ij")
    return numpy.where((x + y + z) % 3 == 0, 0, x + 5 * y + 20 * z).astype(dtype)


def run(*words):
    subprocess.run(words, check=True)


# numpy
for name in "? i1 u1 <i2 >i2 <u2 >u2 <i4 >i4 <u4 <i8 >i8 <u8 <f2 >f2 <f4 >f4 <f8 >f8".split():
    code = name.replace("<", "little_").replace(">", "big_").replace("?", "bool")
    numpy.save(f"{code}.npy", volume(name))
numpy.save("fortran.npy", numpy.asfortranarray(volume("<i2")))
numpy.save("zyx.npy", numpy.ascontiguousarray(volume("<i2").transpose(2, 1, 0)))
numpy.save("zyx_fortran.npy", numpy.asfortranarray(volume("<i2").transpose(2, 1, 0)))
numpy.save("slice.npy", volume("u1")[:, :, 4])
numpy.save("slice_rows.npy", numpy.ascontiguousarray(volume("u1")[:, :, 4].T))
numpy.save("four_axes.npy", volume("u1")[None, :, :, :])
for version in (2, 3):
    with open(f"version{version}.npy", "wb") as file:
        numpy.lib.format.write_array(file, volume("u1"), version=(version, 0))
numpy.save("objects.npy", numpy.array([[None, 1], [2, "a"]], dtype=object), allow_pickle=True)
numpy.save("records.npy", numpy.zeros((2, 2, 2), dtype=[("a", "i4"), ("b", "f4")]))
numpy.save("complex.npy", numpy.zeros((2, 2, 2), dtype="c8"))

# Plain numbers
volume("<u2").transpose(2, 1, 0).tofile("little_u2.raw")
volume(">f4").transpose(2, 1, 0).tofile("big_f4.raw")

# NIfTI: turned by a quarter about z
place = numpy.array([[0, -2, 0, 10], [2, 0, 0, -5], [0, 0, 2, 1], [0, 0, 0, 1]])
for name in ("sform.nii", "sform.nii.gz"):
    nibabel.Nifti1Image(volume("<i2"), place).to_filename(name)
image = nibabel.Nifti1Image(volume("<i2"), None)
image.header.set_qform(place, code=1)
image.header.set_sform(None, code=0)
image.to_filename("qform.nii")
mirrored = place.copy()
mirrored[2, 2] = -2
image.header.set_qform(mirrored, code=1)
image.to_filename("mirrored.nii")
image = nibabel.Nifti1Image(volume("<f4"), None)
image.header.set_zooms((0.5, 0.5, 1))
image.to_filename("pixdim.nii")
header = nibabel.Nifti1Header(endianness=">")
header.set_data_dtype(">i2")
nibabel.Nifti1Image(volume(">i2"), place, header=header).to_filename("big.nii")
image = nibabel.Nifti1Image(volume("u1"), place)
image.header.set_slope_inter(0.5, 0)
image.to_filename("slope.nii")
nibabel.Nifti2Image(volume("u1"), place).to_filename("nifti2.nii")
nibabel.Nifti1Pair(volume("u1"), place).to_filename("pair.img")
pathlib.Path("pair.img").unlink()

# NRRD, by Teem
run("teem-unu", "make", "-i", "little_u2.raw", "-t", "ushort", "-s", "4", "3", "5", "-en", "little",
    "-sp", "0.5", "0.5", "1", "-o", "made.nrrd")
for encoding in ("raw", "gzip", "text", "hex"):
    run("teem-unu", "save", "-i", "made.nrrd", "-f", "nrrd", "-e", encoding, "-o", f"{encoding}.nrrd")
run("teem-unu", "save", "-i", "made.nrrd", "-f", "nrrd", "-e", "gzip", "-o", "detached.nhdr")
pathlib.Path("made.nrrd").unlink()
run("teem-unu", "make", "-i", "big_f4.raw", "-t", "float", "-s", "4", "3", "5", "-en", "big", "-spc", "3",
    "-dirs", "(0,2,0) (-2,0,0) (0,0,2)", "-orig", "(10,-5,1)", "-o", "placed.nrrd")

# Pictures
for z in range(5):
    rows = numpy.ascontiguousarray(volume("u1")[:, :, z].T)
    Image.fromarray(rows).save(f"slice_{z + 8:03d}.png")
    run("convert", f"slice_{z + 8:03d}.png", f"s{z + 8}.pgm")
rows = numpy.ascontiguousarray(volume("<u2")[:, :, 4].T)
Image.fromarray(rows).save("wide.png")
Image.fromarray(rows.astype("u1")).convert("RGB").save("rgb.png")
Image.fromarray(rows.astype("u1")).convert("LA").save("alpha.png")
Image.fromarray(rows > 0).save("bits.png")
Image.fromarray(rows.astype("u1")).convert("P").save("palette.png")
run("convert", "slice_012.png", "-interlace", "PNG", "interlaced.png")
run("convert", "slice_012.png", "-compress", "none", "text.pgm")
run("convert", "wide.png", "-depth", "16", "wide.pgm")
color = numpy.zeros((3, 4, 3), "u1")
color[1, 2, 0] = 200
Image.fromarray(color).save("color.png")

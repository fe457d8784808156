// SPDX-License-Identifier: Apache-2.0
// A chart in pixels, drawn by cairo.

#include "ChartLayout.h"

#include <openvdb/Exceptions.h>

#ifdef SPHERETREE_WITH_CAIRO
#include <cairo.h>

#include <cstdint>
#include <cstring>
#include <memory>
#endif

namespace openvdb_spheretree {

#ifdef SPHERETREE_WITH_CAIRO

namespace {

using namespace detail;

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Pen = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

void requireFine(cairo_status_t status)
{
    if (status == CAIRO_STATUS_SUCCESS) return;
    OPENVDB_THROW(openvdb::IoError, "cannot draw the chart: " << cairo_status_to_string(status));
}

void takeInk(cairo_t* pen, Ink ink)
{
    const uint32_t color = inkColors()[std::size_t(ink)].light;
    cairo_set_source_rgb(
        pen, (color >> 16) / 255.0, (color >> 8 & 255) / 255.0, (color & 255) / 255.0);
}

void addPath(cairo_t* pen, const std::vector<ChartPoint>& points)
{
    cairo_new_path(pen);
    for (const ChartPoint& point : points) cairo_line_to(pen, point[0], point[1]);
}

void drawLine(cairo_t* pen, const ChartLine& line)
{
    constexpr double kDashes[] = {7, 5};
    takeInk(pen, line.ink);
    cairo_set_line_width(pen, line.width);
    cairo_set_dash(pen, kDashes, line.dashed ? 2 : 0, 0);
    addPath(pen, line.points);
    cairo_stroke(pen);
}

void drawText(cairo_t* pen, const ChartText& label)
{
    takeInk(pen, label.ink);
    cairo_set_font_size(pen, label.size);
    cairo_text_extents_t extents;
    cairo_text_extents(pen, label.text.c_str(), &extents);
    cairo_save(pen);
    cairo_translate(pen, label.at[0], label.at[1]);
    if (label.upwards) cairo_rotate(pen, -1.57079632679489661923);
    cairo_move_to(pen, -extents.x_advance * int(label.anchor) / 2, 0); // start, middle, end
    cairo_show_text(pen, label.text.c_str());
    cairo_restore(pen);
}

/// @return the pixels of cairo, which are 0xXXRRGGBB in the order of the machine's bytes.
Picture pictureOf(cairo_surface_t* surface)
{
    cairo_surface_flush(surface);
    Picture picture;
    picture.width = cairo_image_surface_get_width(surface);
    picture.height = cairo_image_surface_get_height(surface);
    picture.rgb.reserve(3 * std::size_t(picture.width) * std::size_t(picture.height));
    const unsigned char* row = cairo_image_surface_get_data(surface);
    for (int y = 0; y < picture.height; ++y, row += cairo_image_surface_get_stride(surface)) {
        for (int x = 0; x < picture.width; ++x) {
            uint32_t pixel = 0;
            std::memcpy(&pixel, row + 4 * std::size_t(x), sizeof(pixel));
            for (const int shift : {16, 8, 0}) picture.rgb.push_back(uint8_t(pixel >> shift));
        }
    }
    return picture;
}

} // namespace

bool drawsCharts() { return true; }

Picture drawChart(const std::vector<ErrorCurve>& curves, const ChartSize& size)
{
    const ChartLayout chart = layOutChart(curves, size);
    const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, size.width, size.height),
        cairo_surface_destroy);
    const Pen pen(cairo_create(surface.get()), cairo_destroy);
    cairo_scale(pen.get(), size.width / chart.width, size.height / chart.height);
    cairo_set_line_join(pen.get(), CAIRO_LINE_JOIN_ROUND);
    cairo_select_font_face(
        pen.get(), "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    takeInk(pen.get(), Ink::Paper);
    cairo_paint(pen.get());
    for (const ChartLine& line : chart.lines) drawLine(pen.get(), line);
    for (const ChartMark& mark : chart.marks) {
        takeInk(pen.get(), mark.ink);
        addPath(pen.get(), mark.corners);
        cairo_fill(pen.get());
    }
    for (const ChartText& label : chart.texts) drawText(pen.get(), label);
    requireFine(cairo_status(pen.get()));
    requireFine(cairo_surface_status(surface.get()));
    return pictureOf(surface.get());
}

#else

bool drawsCharts() { return false; }

Picture drawChart(const std::vector<ErrorCurve>&, const ChartSize&)
{
    OPENVDB_THROW(openvdb::IoError,
        "this build draws charts as .svg only; for .png install cairo (Debian: libcairo2-dev) and "
        "configure with -DSPHERETREE_WITH_CAIRO=ON");
}

#endif

} // namespace openvdb_spheretree

// SPDX-License-Identifier: Apache-2.0
#include "Tree.h"

#include "ForbidNew.h"

#include <openvdb_spheretree/store/JsonWriter.h>
#include <openvdb_spheretree/tree/SphereCuts.h>

#include <openvdb/math/Maps.h>
#include <openvdb/math/Transform.h>
#include <pybind11/numpy.h>

#include <string>
#include <utility>

namespace py = pybind11;

namespace binding {

namespace spheretree = openvdb_spheretree;
using spheretree::SphereTree;

static_assert(sizeof(openvdb::Vec3d) == 3 * sizeof(double) && sizeof(openvdb::Coord) == 12,
    "arrays show them as rows of three");

namespace {

/// A read-only view of values that @a owner keeps alive.
template <typename T>
py::array viewOf(const T* data, std::vector<py::ssize_t> shape, const py::handle& owner)
{
    py::array view(py::dtype::of<T>(), std::move(shape), data, owner);
    view.attr("setflags")(py::arg("write") = false);
    return view;
}

template <typename T>
py::array viewOf(const std::vector<T>& values, const py::handle& owner)
{
    return viewOf(values.data(), {py::ssize_t(values.size())}, owner);
}

template <typename Number, typename Row>
py::array rowsOf(const std::vector<Row>& rows, const py::handle& owner)
{
    return viewOf(
        reinterpret_cast<const Number*>(rows.data()), {py::ssize_t(rows.size()), 3}, owner);
}

/// Adds a property that is a view of what get(tree) returns.
template <typename Class, typename View>
void defineView(Class& binding, const char* name, const View& view)
{
    binding.def_property_readonly(
        name, [view](const py::object& self) { return view(py::cast<const Tree&>(self), self); });
}

/// What a tree knows beside its nodes, in the words of -stats and .json.
std::string descriptionOf(const Tree& handle)
{
    const SphereTree& tree = handle.get();
    spheretree::JsonWriter json;
    json.beginObject();
    json.value("name", tree.settings.name);
    spheretree::writeObject(json, tree);
    json.beginObject("settings");
    spheretree::writeSettings(json, tree);
    json.endObject();
    json.beginArray("levels");
    for (const auto& level : tree.levels) {
        json.beginObject();
        json.value("level", level.level);
        json.value("begin", level.begin);
        json.value("end", level.end);
        json.value("pyramid_voxels", level.pyramidVoxels);
        spheretree::writeTopology(json, level);
        json.beginObject("errors");
        spheretree::writeError(json, level);
        json.endObject();
        json.endObject();
    }
    json.endArray();
    json.endObject();
    return json.text();
}

py::array matrixOf(const Tree& handle)
{
    const openvdb::Mat4d matrix =
        handle.get().transform->baseMap()->getAffineMap()->getMat4().transpose();
    return py::array_t<double>({4, 4}, matrix.asPointer());
}

/// An array of its own: edges are pairs in a struct.
py::array edgesOf(const Tree& handle)
{
    const auto& edges = handle.get().dag;
    py::array_t<int32_t> array({py::ssize_t(edges.size()), py::ssize_t(2)});
    int32_t* to = array.mutable_data();
    for (const auto& edge : edges) {
        *to++ = edge.parent;
        *to++ = edge.child;
    }
    return array;
}

} // namespace

Tree::Tree(SphereTree tree) : mTree(std::move(tree))
{
    mCenters.reserve(std::size_t(mTree.size()));
    for (int32_t id = 0; id < mTree.size(); ++id) mCenters.push_back(mTree.centerWorld(id));
}

void bindTree(py::module_& module)
{
    py::class_<Tree, TreePtr> tree(module, "Tree");
    forbidNew(tree);
    defineView(tree, "centers", [](const Tree& t, const py::handle& owner) {
        return rowsOf<double>(t.centersWorld(), owner);
    });
    defineView(tree, "radii", [](const Tree& t, const py::handle& owner) {
        return viewOf(t.get().spheres.radiusWorld, owner);
    });
    defineView(tree, "parents", [](const Tree& t, const py::handle& owner) {
        return viewOf(t.get().spheres.parent, owner);
    });
    defineView(tree, "tracks",
        [](const Tree& t, const py::handle& owner) { return viewOf(t.get().track, owner); });
    defineView(tree, "ijk",
        [](const Tree& t, const py::handle& owner) { return rowsOf<int32_t>(t.get().ijk, owner); });
    defineView(tree, "radii_sq",
        [](const Tree& t, const py::handle& owner) { return viewOf(t.get().radiusSq, owner); });
    tree.def_property_readonly("edges", edgesOf)
        .def_property_readonly("description", descriptionOf)
        .def_property_readonly("matrix", matrixOf)
        .def("level",
            [](const Tree& t, int level) {
                return std::make_shared<Tree>(spheretree::keepLevel(t.get(), level));
            })
        .def("cut", [](const Tree& t, int64_t spheres) {
            return std::make_shared<Tree>(spheretree::cutTree(t.get(), spheres));
        });
}

} // namespace binding

// SPDX-License-Identifier: Apache-2.0
/// @file SphereTreeSettings.h
/// @brief What a sphere-tree is built by: settings that all kinds of trees share, and the options
/// of one kind.
///
///     ExtendedOptions options;
///     options.factor = 3;
///     SphereTreeSettings settings = options;
///     settings.name = "coarse";
///
/// Every field is recorded in the tree that is built, and all but `memory` in the files written
/// from it.

#pragma once

#include "SphereBudget.h"
#include <openvdb_spheretree/pyramid/Closing.h>
#include <openvdb_spheretree/pyramid/PyramidModel.h>
#include <openvdb_spheretree/voxel/Dimension.h>
#include <openvdb_spheretree/voxel/Distance.h>

#include <openvdb/math/Coord.h>

#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

namespace openvdb_spheretree {

/// The names of trees: those of any side go by `Tight`. `Given` are spheres that were not built here.
enum class TreeType { Reversible, Extended, Tight, Given };

enum class ParentRule {
    Centre, ///< the label of the parent voxel of the ball's center (the paper's rule)
    Dag     ///< among the ball's parents in the Sphere-DAG, the one it protrudes from least
};

enum class Reconstruction {
    Clip, ///< rebuild a level from its spheres, within the box of the object's own pyramid level
    Free, ///< the same without the box: levels swell, and may need more steps to end at one sphere
    None  ///< coarsen a level as it is
};

enum class DagEdges {
    Shared,      ///< balls whose power cells share a voxel (Definition 2): SphereDag.h
    Intersecting ///< all spheres that meet (Eq. 3), for study: IntersectionDag.h
};

enum class RadiusScale {
    Tight, ///< f^k sqrt(radiusSq - 1) + sqrt(dim) (f^k - 1) / 2: no more than coverage needs
    Paper  ///< f^k sqrt(radiusSq) in place of the first term, on the levels above 0
};

/// How much work goes into a tight tree.
enum class Quality {
    Fast,   ///< balls merged and placed anew by turns, with little effort
    Normal, ///< with more effort, and levels of up to 64 balls searched
    Best    ///< all levels searched, and for longer
};

/// What a sphere contains for certain.
enum class Cover {
    Voxels, ///< tight trees: every object voxel has a chain of spheres from top to bottom
    Balls   ///< every leaf ball below it
};

/// Where reversible and extended trees have their spheres' centers.
enum class Center {
    Medial,  ///< the center of the medial ball
    Miniball ///< that of the smallest sphere around the leaf balls below
};

/// What level 0 of a tight tree is made of.
enum class Leaves {
    Pruned, ///< the medial balls that are left when those go whose voxels all lie in others
    Medial, ///< all medial balls
    Given   ///< spheres that come from elsewhere: buildSphereTreeOver()
};

/// What tight trees of all sides share.
struct BudgetOptions {
    SphereBudget budget; ///< which levels there are
    bool cuts = false;   ///< also keep the tree for every number of spheres: SphereCuts.h
};

/// The least error known for a number of spheres.
struct TightOptions : BudgetOptions {
    Quality quality = Quality::Normal;
    Cover cover = Cover::Voxels;
    Leaves leaves = Leaves::Pruned;
};

/// Spheres that lie inside the object, and cover as much of it as they can. Their budget has no
/// bound on the error, and their radii no padding.
struct InnerOptions : BudgetOptions {
    /// Spheres lie inside the union of the object's voxel cubes, not only away from the centers of other
    /// voxels.
    bool strict = false;
};

/// Spheres nearest to the object: with as little excess + missing as a search finds for their number. They
/// neither lie inside nor cover it. Their budget has no bound on the distance, their radii no padding, and
/// there are no cuts.
struct FitOptions : BudgetOptions {};

/// What the two trees of the paper share, which are built along a pyramid.
struct PyramidOptions {
    /// Voxels of a level merged per axis into one voxel of the next level: 2 to kMaxFactor.
    int factor = 2;
    /// Pyramid model: 0 for OR, else OR after a closing of this radius (voxels of the child level).
    int closing = 0;
    /// An including model of one's own, in place of the above. It sees an object with dim = 2
    /// turned so that it is flat along z. Files record that there was one, not which: a tree read
    /// back has one that isUnknown().
    PyramidModel customModel;
    /// Index of voxel (0,0,0) of the pyramid's levels: multiples of 8, and along no axis above the
    /// object's first voxel. Empty: that voxel's coordinates, rounded down to such multiples.
    std::optional<openvdb::Coord> origin;
    Distance dist; ///< what the balls are balls of
    Center center = Center::Medial;
    ParentRule parent = ParentRule::Centre;
    /// How the radii of a level's balls become those of level 0. In an extended tree only
    /// parent = Dag asks for them.
    RadiusScale scale = RadiusScale::Tight;
    bool dag = false;                  ///< also collect the edges of the Sphere-DAG
    DagEdges edges = DagEdges::Shared; ///< which ones; parent = Dag always goes by shared voxels
};

/// Every sphere contains the leaf balls below it (Broutta et al. 2009, Algorithm 2).
struct ExtendedOptions : PyramidOptions {
    /// Store the smallest sphere around its own center that contains the leaf balls below it
    /// (Section 4.2 of the paper), rather than the one that the reconstruction used.
    bool finalFit = true;
    Reconstruction reconstruct = Reconstruction::Clip;
};

/// Every level rebuilds its own pyramid level (Broutta et al. 2009, 3.2).
struct ReversibleOptions : PyramidOptions {};

/// Spheres that were read, and promise nothing (GivenTree.h): one level, as large as they are. No
/// object has such a tree built.
struct GivenOptions {};

struct SphereTreeSettings {
    using Kind = std::variant<TightOptions, InnerOptions, FitOptions, ExtendedOptions,
        ReversibleOptions, GivenOptions>;

    Kind kind; ///< which kind of tree, and what only such trees can be asked for
    /// 3, or 2 for an object one voxel thick along an axis, which then takes no part.
    int dim = 3;
    /// Added to every radius that is stored, in voxels of level 0: 0 covers voxel centers, and
    /// kPadCubes (the only negative value) stands for sqrt(dim) / 2, which covers whole cubes.
    double padding = kPadCubes;
    /// Also count components, tunnels and cavities of the voxels of every level.
    bool topology = true;
    /// Name of the tree, and of the grid it is stored in.
    std::string name = "spheretree";
    /// Bytes that the labels of a level and what they are made from may take while they are
    /// computed, and after that the levels of a tight tree while they are made; 0 for three
    /// quarters of the machine's memory. Labels that need more are compressed, and then go to a
    /// temporary file (docs/algorithm.md, "Less memory than that"); levels that do are refused.
    /// The tree is the same whatever it is, so no file records it.
    int64_t memory = 0;

    static constexpr double kPadCubes = -1.0;
    static constexpr double kMaxPadding = 1e9;

    SphereTreeSettings() = default;
    /// Any of the kinds above, all else at its default.
    template <typename Options,
        typename = std::enable_if_t<
            std::is_constructible_v<Kind,
                Options> && !std::is_same_v<std::decay_t<Options>, SphereTreeSettings>>>
    SphereTreeSettings(Options&& options) : kind(std::forward<Options>(options))
    {}

    TreeType type() const;
    bool isInner() const { return std::holds_alternative<InnerOptions>(kind); }
    bool isFit() const { return std::holds_alternative<FitOptions>(kind); }
    bool isGiven() const { return std::holds_alternative<GivenOptions>(kind); }

    /// @return the options, if the kind is or shares these; else null.
    template <typename Options>
    const Options* find() const
    {
        return std::visit(
            [](const auto& options) -> const Options* {
                using Own = std::decay_t<decltype(options)>;
                if constexpr (std::is_base_of_v<Options, Own>) return &options;
                else return nullptr;
            },
            kind);
    }
    template <typename Options>
    Options* find()
    {
        return const_cast<Options*>(std::as_const(*this).template find<Options>());
    }
    /// @name The options of a kind, or that it shares
    /// tight() is that of trees with side=outer alone; budgeted() is for any side.
    /// @throw openvdb::ValueError if the tree is of another kind
    /// @{
    const TightOptions& tight() const { return required(find<TightOptions>(), "tight"); }
    TightOptions& tight() { return required(find<TightOptions>(), "tight"); }
    const ExtendedOptions& extended() const
    {
        return required(find<ExtendedOptions>(), "extended");
    }
    ExtendedOptions& extended() { return required(find<ExtendedOptions>(), "extended"); }
    const BudgetOptions& budgeted() const { return required(find<BudgetOptions>(), "tight"); }
    BudgetOptions& budgeted() { return required(find<BudgetOptions>(), "tight"); }
    const PyramidOptions& pyramid() const { return required(find<PyramidOptions>(), "pyramid"); }
    PyramidOptions& pyramid() { return required(find<PyramidOptions>(), "pyramid"); }
    /// @}

    /// @return that of the pyramid's options; Euclidean for other trees.
    const Distance& dist() const;
    /// @return the padding in voxels of level 0: none for inner trees, nearest spheres (side=fit) and given ones.
    double paddingVoxels() const;
    /// @throw openvdb::ValueError naming the first setting out of range, and its range.
    void validate() const;

private:
    [[noreturn]] static void throwOtherKind(const char* wanted);
    template <typename Options>
    static Options& required(Options* options, const char* wanted)
    {
        if (!options) throwOtherKind(wanted);
        return *options;
    }
};

/// @return whether @a model stands for one that a file could not record: it throws when called.
bool isUnknown(const PyramidModel& model);
/// @throw openvdb::ValueError from the model, when it is called
PyramidModel unknownModel();

/// @name The names that the command line and the metadata of files use
/// @{
const char* toString(TreeType);
const char* toString(ParentRule);
const char* toString(Reconstruction);
const char* toString(RadiusScale);
const char* toString(DagEdges);
const char* toString(Leaves);
const char* toString(Center);
const char* toString(Cover);
const char* toString(Quality);
/// @return "cubes", "voxels", or the number as text.
std::string paddingToString(double padding);
/// @return "75%" for 0, else the bytes, in GiB and so on where they come to a whole number.
std::string memoryToString(int64_t memory);
/// @return "or", "closing:2" and so on, or "custom".
std::string modelToString(const PyramidOptions&);
/// @throw openvdb::ValueError naming the value and the values there are.
double paddingFromString(const std::string&);
/// @return the bytes of "4GiB", "500MB", "4e9" or, as a share of the machine's memory, "50%"; 0 for
///         "75%".
int64_t memoryFromString(const std::string&);
/// @return the radius of "closing:R", 0 for "or".
int closingFromString(const std::string&);
/// @return the coordinates of "0,-8,16"; nothing of an empty text.
std::optional<openvdb::Coord> originFromString(const std::string&);
std::string originToString(const std::optional<openvdb::Coord>&);
/// @}

} // namespace openvdb_spheretree

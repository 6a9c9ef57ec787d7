// SPDX-License-Identifier: LGPL-2.1-or-later
// Samples of a scene, shared among the ranks and judged one by one.
#include <keyblock/base/number_text.h>
#include <keyblock/base/stop_request.h>
#include <keyblock/blocks/mesh_fidelity.h>
#include <keyblock/run/probability_study.h>
#include <keyblock/scene/entries.h>
#include <keyblock/scene/solid.h>
#include <keyblock/scene/study_entries.h>


#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <limits>

namespace Keyblock
{
  namespace
  {
    /** Samples per rank from one writing of samples.csv to the next, at most.
     */
    constexpr unsigned int most_per_batch = 64;

    /** Seconds between two writings: fewer samples where they take more. */
    constexpr double least_seconds = 1., most_seconds = 4.;
  } // namespace



  template <int dim>
  ProbabilityStudy<dim>::ProbabilityStudy(
    const Communicator &communicator,
    const std::string &scene_file,
    const std::vector<std::string> &overrides,
    const std::string &output_folder)
    : communicator(communicator)
    , scene_file(scene_file)
    , overrides(overrides)
  {
    scene.read(communicator, scene_file, overrides);
    AssertThrow(!scene.study_variables.empty(),
                InputError("The scene '" + scene_file +
                           "' has nothing to vary; name variables in the "
                           "entry 'Study/Names'."));
    folder =
      (!output_folder.empty() ? output_folder
       : !scene.output.folder.empty()
         ? scene.output.folder
         : "output-" + std::filesystem::path(scene_file).stem().string()) +
      "/";
    draw();
    check_study_values(scene, values);
    strengths = std::make_unique<VariedStrengths<dim>>(
      scene, values, [&](const std::vector<double> &drawn, Scene<dim> &sample) {
        sample.read(communicator, scene_file, overrides_of(drawn));
      });
  }



  template <int dim>
  bool
  ProbabilityStudy<dim>::changes_geometry() const
  {
    return std::any_of(scene.study_variables.begin(),
                       scene.study_variables.end(),
                       [](const auto &v) {
                         return !leaves_geometry(v->entry);
                       });
  }



  template <int dim>
  BlockGeometry<dim>
  ProbabilityStudy<dim>::make_geometry(const Scene<dim> &sample) const
  {
    // blocks are numbered as those of a run, unless nothing refers to them
    auto between_planes = make_plane_geometry(
      sample, changes_geometry() && scene.study.level != StudyLevel::full);
    if (std::holds_alternative<BlockGeometry<dim>>(between_planes))
      return std::move(std::get<BlockGeometry<dim>>(between_planes));
    // each rank for itself
    BlockGeometry<dim> made =
      make_block_geometry(Communicator(MPI_COMM_SELF),
                          sample,
                          dealii::ConditionalOStream(std::cout, false));
    made.warnings = warnings_of_coarse_mesh(sample, made.split, made.blocks);
    return made;
  }



  template <int dim>
  std::vector<std::string>
  ProbabilityStudy<dim>::overrides_of(const std::vector<double> &drawn) const
  {
    std::vector<std::string> list = overrides;
    for (unsigned int v = 0; v < drawn.size(); ++v)
      list.push_back(scene.study_variables[v]->entry + "=" +
                     exact_text(drawn[v]));
    return list;
  }



  template <int dim>
  std::vector<std::string>
  ProbabilityStudy<dim>::overrides_of(const unsigned int index) const
  {
    std::vector<double> drawn;
    for (const std::vector<double> &all : values)
      drawn.push_back(all[index]);
    return overrides_of(drawn);
  }



  template <int dim>
  void
  ProbabilityStudy<dim>::judge_batch(const unsigned int begin,
                                     const unsigned int end)
  {
    const unsigned int n_blocks = geometry ? geometry->blocks.blocks.size() : 0;
    const unsigned int n        = n_sample_figures + n_blocks;
    std::vector<double> figures(std::size_t(n) * (end - begin), 0.);
    std::string message;
    for (unsigned int i = begin; i < end && message.empty(); ++i)
      if (i % communicator.size() == communicator.rank())
        try
          {
            const std::vector<double> row = figures_of(judge_named(i, true));
            std::copy(row.begin(),
                      row.end(),
                      &figures[std::size_t(n) * (i - begin)]);
          }
        catch (const InputError &error)
          {
            message = error.message;
          }
        catch (const StopRequest &)
          {
            break; // all ranks stop together
          }
    stop_if_asked(communicator);
    message = communicator.any_text(message);
    AssertThrow(message.empty(), InputError(message));
    communicator.sum_lists(figures);
    for (unsigned int i = begin; i < end; ++i)
      results.push_back(result_of(&figures[std::size_t(n) * (i - begin)], n));
  }



  template <int dim>
  double
  ProbabilityStudy<dim>::length_of_tunnel() const
  {
    if (dim == 2)
      return 1.;
    double low = std::numeric_limits<double>::max(), high = -low;
    for (const auto &excavation : scene.excavations)
      if (excavation->shape == ExcavationShape::extruded_polygon)
        {
          low  = std::min(low, excavation->from);
          high = std::max(high, excavation->to);
        }
      else
        for (const auto &solid : excavation->solids)
          {
            low  = std::min(low, solid->low[1]);
            high = std::max(high, solid->high[1]);
          }
    return std::max(0., high - low);
  }



  template <int dim>
  void
  ProbabilityStudy<dim>::run()
  {
    const double start = MPI_Wtime();
    if (!changes_geometry())
      geometry = std::make_unique<BlockGeometry<dim>>(make_geometry(scene));
    // the weaker of two joints rules where they share faces
    if (geometry && geometry->depends_on_strength)
      geometry = nullptr;
    header = make_header();
    read_samples();
    // what no sample can be made of is said before anything is written
    if (results.empty())
      judge_named(0, false);
    strengths->reset();
    n_resumed = results.size();
    communicator.on_root([&]() {
      std::error_code error;
      std::filesystem::create_directories(folder, error);
      AssertThrow(!error,
                  InputError("The output folder '" + folder +
                             "' cannot be made; check its path and "
                             "permissions."));
      begin_table();
      scene.write_used(folder + "used.prm");
    });
    unsigned int per_rank = 1;
    while (results.size() < scene.study.samples)
      {
        stop_if_asked(communicator);
        const double batch_start = MPI_Wtime();
        const unsigned int begin = results.size();
        judge_batch(begin,
                    std::min(scene.study.samples,
                             begin + per_rank * communicator.size()));
        write_samples(begin);
        const double seconds = communicator.max(MPI_Wtime() - batch_start);
        if (seconds < least_seconds)
          per_rank = std::min(2 * per_rank, most_per_batch);
        else if (seconds > most_seconds)
          per_rank = std::max(1u, per_rank / 2);
      }
    const StudyReport report(scene,
                             geometry ? &geometry->blocks : nullptr,
                             values,
                             results,
                             geometry ? geometry->warnings
                                      : std::vector<std::string>(),
                             length_of_tunnel(),
                             MPI_Wtime() - start,
                             n_resumed);
    if (communicator.is_root())
      report.print(std::cout);
    communicator.assert_written(!communicator.is_root() ||
                                  report.write(folder + "study.json"),
                                folder + "study.json");
  }

  template class ProbabilityStudy<2>;
  template class ProbabilityStudy<3>;
} // namespace Keyblock

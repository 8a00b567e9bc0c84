#include <cmath>
#include <map>
#include <type_traits>
#include <utility>

#include "paper.h"
#include "reference/implicit.h"

namespace lks_accuracy {
namespace {

constexpr double pressure = 1.5;
constexpr double mass = 1; // kg
constexpr int frames = 200;

// An icosahedron whose triangles are cut into four `cuts` times, on the unit sphere.
struct Shell {
    std::vector<support::Vector> points;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;

    explicit Shell(int cuts) {
        const double phi = (1 + std::sqrt(5.0)) / 2;
        for (const double i : {-1.0, 1.0}) {
            for (const double j : {-1.0, 1.0}) {
                add({0, i, j * phi});
                add({i, j * phi, 0});
                add({i * phi, 0, j});
            }
        }
        for (std::uint32_t a = 0; a < 12; ++a) {
            for (std::uint32_t b = a + 1; b < 12; ++b) {
                for (std::uint32_t c = b + 1; c < 12; ++c) {
                    if (near(a, b) && near(b, c) && near(a, c)) {
                        triangles.push_back(outwards({a, b, c}));
                    }
                }
            }
        }
        for (int cut = 0; cut < cuts; ++cut) {
            const std::vector<std::array<std::uint32_t, 3>> whole = std::exchange(triangles, {});
            for (const auto& [a, b, c] : whole) {
                const std::uint32_t ab = middle(a, b);
                const std::uint32_t bc = middle(b, c);
                const std::uint32_t ca = middle(c, a);
                triangles.insert(triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
            }
        }
    }

private:
    std::uint32_t add(const support::Vector& p) {
        points.push_back(p * (1 / p.length()));
        return static_cast<std::uint32_t>(points.size() - 1);
    }
    bool near(std::uint32_t a, std::uint32_t b) const { return (points[a] - points[b]).length() < 1.1; }
    std::array<std::uint32_t, 3> outwards(const std::array<std::uint32_t, 3>& t) const {
        const reference::Vector3<double> a(points[t[0]]);
        const reference::Vector3<double> b(points[t[1]]);
        const reference::Vector3<double> c(points[t[2]]);
        return a.dot(reference::cross(b, c)) > 0 ? t : std::array<std::uint32_t, 3>{t[0], t[2], t[1]};
    }
    std::uint32_t middle(std::uint32_t a, std::uint32_t b) {
        const auto [found, is_new] = middles.try_emplace(std::minmax(a, b), 0);
        if (is_new) {
            found->second = add(points[a] + points[b]);
        }
        return found->second;
    }
};

reference::Model balloon(double shell_compliance, double volume_compliance) {
    const Shell shell(2);
    reference::Model model;
    model.positions = shell.points;
    model.masses.assign(shell.points.size(), mass / static_cast<double>(shell.points.size()));
    for (const auto& t : shell.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = t[k];
            const std::uint32_t b = t[(k + 1) % 3];
            if (a < b) {
                model.edges.push_back(
                    {a, b, (shell.points[a] - shell.points[b]).length(), shell_compliance, 0});
            }
        }
    }
    reference::Volume volume{{}, shell.triangles, 0, volume_compliance};
    for (std::uint32_t p = 0; p < shell.points.size(); ++p) {
        volume.particles.push_back(p);
    }
    reference::Block<double> block;
    std::vector<reference::Vector3<double>> x;
    for (const support::Vector& p : shell.points) {
        x.emplace_back(p);
    }
    evaluate(volume, x, block);
    volume.rest = block.value[0] * pressure;
    model.volumes.push_back(volume);
    return model;
}

template <typename Solver>
BalloonRun run(reference::Engine engine, const reference::Model& model, Solver solver, int iterations) {
    solver.tick(frames);
    if constexpr (std::is_same_v<Solver, reference::ImplicitEuler>) {
        must_have_converged(solver);
    }
    std::vector<support::Vector> positions;
    std::vector<reference::Vector3<double>> widened;
    for (const auto& p : solver.positions()) {
        positions.push_back(p.widened());
        widened.emplace_back(positions.back());
    }
    reference::Block<double> block;
    evaluate(model.volumes.front(), widened, block);
    const double rest = model.volumes.front().rest;
    return {name_of(engine),
            model.edges.front().compliance,
            model.volumes.front().compliance,
            iterations,
            pressure * (block.value[0] + rest) / rest,
            stretch_of(model, positions).mean};
}

template <typename Scalar>
BalloonRun sweep(reference::Engine engine, const reference::Model& model,
                 const reference::Settings& settings) {
    constexpr double pbd_stiffness = 0.1;
    const auto method = engine == reference::Engine::pbd ? reference::Method::pbd : reference::Method::xpbd;
    return run(engine, model, reference::PositionBased<Scalar>(model, settings, method, pbd_stiffness),
               settings.iterations);
}

} // namespace

std::vector<BalloonRun> run_balloon(const std::vector<double>& shell_compliances,
                                    const std::vector<double>& volume_compliances,
                                    const std::vector<int>& iterations) {
    std::vector<BalloonRun> runs;
    for (const double shell : shell_compliances) {
        for (const double volume : volume_compliances) {
            const reference::Model model = balloon(shell, volume);
            reference::Settings settings{60, 1, 1, {}, 10};
            runs.push_back(run(reference::Engine::newton, model,
                               reference::ImplicitEuler(model, settings, reference::Linearisation::full), 0));
            for (const int count : iterations) {
                settings.iterations = count;
                runs.push_back(sweep<double>(reference::Engine::xpbd, model, settings));
                runs.push_back(sweep<float>(reference::Engine::xpbd_single, model, settings));
                runs.push_back(sweep<double>(reference::Engine::pbd, model, settings));
            }
        }
    }
    return runs;
}

} // namespace lks_accuracy

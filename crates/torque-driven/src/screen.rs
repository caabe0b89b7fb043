//! The linearised free run with every effect as a column: which effects could explain what differs.

use faer::Mat;
use robot_model::effect::{MAX_PARAMETERS, Role};
use robot_model::presence::Presence;

use crate::candidate::{Candidate, Ground, evidence, reduced, single};
use crate::fit::{Columns, Fitted, Hypothesis, Lane, Problem, difference};
use crate::local;
use crate::simulate::Response;
use crate::windows::PARTS;
use inference::algebra::select;
use inference::hypothesis::Dose;
use inference::hypothesis::{Free, Place, Variant};

/// One raw lane: a variant at one probe.
struct Probe {
    variant: usize,
    /// Free value that is probed, and its probe.
    index: usize,
    size: f64,
}

/// A strength at `size` (or a shaped strength at its probe), shapes as usual, everywhere or on its side.
fn probe_dose(variant: &Variant, free: &[Free], index: usize, size: f64) -> Dose {
    let mut values: Vec<f64> = variant.spec().parameters.iter().take(MAX_PARAMETERS).map(|p| p.neutral).collect();
    if let Some(i) = free[index].parameter {
        values[i] = size;
    }
    let presence = Presence { side: variant.side(), ..Presence::default() };
    Dose { effect: variant.effect, values, presence }
}

/// Sizes at which a free value is probed.
fn probes(variant: &Variant, free: &Free) -> Vec<f64> {
    let Some(i) = free.parameter else { return Vec::new() };
    let p = &variant.spec().parameters[i];
    if p.role == Role::Shape {
        return Vec::new();
    }
    let scale = free.unit / p.probes[p.probes.len() / 2].abs();
    p.probes.iter().map(|x| x * scale).collect()
}

/// Ranks every variant by its evidence over re-tuning at the point of `base`, where `beside` is present already and
/// its sizes are re-tuned too.
pub(crate) fn screen(
    problem: &Problem<'_>,
    base: &Fitted,
    variants: &[Variant],
    beside: &Hypothesis,
) -> Vec<Candidate> {
    let ground = Ground { problem, base, beside: problem.effect_columns(&base.point, beside, &base.response) };
    let sizes = problem.sizes();
    let mut list: Vec<Probe> = Vec::new();
    let mut locals: Vec<usize> = Vec::new();
    for (v, variant) in variants.iter().enumerate() {
        match variant.place {
            Place::Whole | Place::Side(_) => {
                for (index, f) in variant.free(&sizes).iter().enumerate() {
                    list.extend(probes(variant, f).into_iter().map(|size| Probe { variant: v, index, size }));
                }
            }
            Place::Disc | Place::Onset | Place::OnsetOfSide(_) => locals.push(v),
        }
    }

    // Local forms of the same effect on the same side share their part lanes.
    let lanes_of = |v: usize| (variants[v].spec().id, variants[v].side());
    let mut part_of: Vec<(&'static str, Option<usize>)> = locals.iter().map(|&v| lanes_of(v)).collect();
    part_of.sort_unstable();
    part_of.dedup();
    let mut doses: Vec<(Dose, Option<usize>)> = list
        .iter()
        .map(|p| (probe_dose(&variants[p.variant], &variants[p.variant].free(&sizes), p.index, p.size), None))
        .collect();
    for of in &part_of {
        let Some(&v) = locals.iter().find(|&&v| lanes_of(v) == *of) else { continue };
        let (variant, free) = (&variants[v], variants[v].free(&sizes));
        doses.extend((0..PARTS).map(|q| (probe_dose(variant, &free, 0, free[0].usual), Some(q))));
    }

    // All probes and parts are lanes of one simulation.
    let makers: Vec<_> = doses
        .iter()
        .map(|(d, _)| {
            move |run: usize| {
                let mut all = beside.doses(&base.point.effects, run);
                all.push(d.clone());
                all
            }
        })
        .collect();
    let lanes: Vec<Lane<'_>> = doses
        .iter()
        .zip(&makers)
        .map(|((_, part), m)| Lane {
            point: base.point.clone(),
            doses: m,
            part: *part,
            acting: beside.acting_at(&base.point.effects),
        })
        .collect();
    let raw: Vec<Response> = problem.lanes(&lanes).iter().map(|y| difference(y, &base.response, 1.0)).collect();

    let mut out = whole(&ground, variants, &list, &raw[..list.len()]);
    for (n, of) in part_of.iter().enumerate() {
        let parts = &raw[list.len() + n * PARTS..list.len() + (n + 1) * PARTS];
        for &v in locals.iter().filter(|&&v| lanes_of(v) == *of) {
            let found = match variants[v].place {
                Place::Disc => local::disc(&ground, &variants[v], parts),
                _ => local::onset(&ground, &variants[v], parts),
            };
            out.extend(found);
        }
    }
    out.sort_by(|a, b| b.evidence.total_cmp(&a.evidence));
    out
}

fn whole(ground: &Ground<'_>, variants: &[Variant], list: &[Probe], raw: &[Response]) -> Vec<Candidate> {
    let problem = ground.problem;
    let Some((a, b)) = reduced(ground, Columns(raw.to_vec())) else { return Vec::new() };
    let mut out = Vec::new();
    for (v, variant) in variants.iter().enumerate() {
        let mine: Vec<usize> = (0..list.len()).filter(|&i| list[i].variant == v).collect();
        if mine.is_empty() {
            continue;
        }
        let free = variant.free(&problem.sizes());
        let mut start: Vec<f64> = free.iter().map(|f| f.usual).collect();
        let best = if variant.spec().is_linear() && mine.len() > 1 {
            let (a, b) = (select(&a, &mine), Mat::from_fn(mine.len(), 1, |i, _| b[(mine[i], 0)]));
            evidence(&a, &b).map(|(value, x, _)| {
                for (&i, x) in mine.iter().zip(x) {
                    start[list[i].index] = x * list[i].size;
                }
                value
            })
        } else {
            let tries = mine.iter().filter_map(|&i| {
                let (value, x) = single(a[(i, i)], b[(i, 0)], variant.spec().signed)?;
                let size = if variant.spec().is_linear() { x * list[i].size } else { list[i].size };
                Some((value, list[i].index, size))
            });
            tries.max_by(|x, y| x.0.total_cmp(&y.0)).map(|(value, index, size)| {
                start[index] = size.clamp(free[index].bounds[0], free[index].bounds[1]);
                value
            })
        };
        if let Some(evidence) = best {
            out.push(Candidate { variant: *variant, start, onsets: Vec::new(), evidence });
        }
    }
    out
}

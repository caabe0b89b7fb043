//! What is there in some recordings only, though not from an instant on.
//!
//! A load that was put on for two drives of four, a slope under one of them: no effect explains such recordings together. Where the
//! mismatch shows in some of them and in others not at all, those are diagnosed by themselves.

use std::collections::{BTreeMap, BTreeSet};

use inference::{DiagnosisError, Options};
use verdict::{Diagnosis, Verdict};

use crate::case::Case;
use crate::diagnose::Calibrated;
use crate::run::Run;

impl Calibrated {
    /// The diagnosis of those recordings alone in which the mismatch shows, where nothing explains all of them and something explains
    /// these. Only references tell in which it shows.
    pub(crate) fn of_some_drives(
        &self,
        case: &Case,
        options: &Options,
        progress: &dyn Fn(&str),
        of_all: &Diagnosis,
    ) -> Result<Option<Diagnosis>, DiagnosisError> {
        let shows: BTreeSet<&str> = of_all.located.spans.iter().map(|span| span.recording.as_str()).collect();
        let (some, others): (Vec<Run>, Vec<Run>) =
            case.recordings.iter().cloned().partition(|run| shows.contains(run.name.as_str()));
        if of_all.verdict != Verdict::Unknown || some.is_empty() || others.is_empty() {
            return Ok(None);
        }

        progress("diagnosing the recordings that differ by themselves");
        let of_some = Case { recordings: some, ..case.clone() };
        let mut out = self.diagnose(&of_some, options, progress)?;
        if out.verdict != Verdict::Explained {
            return Ok(None);
        }
        tell(&mut out, &of_some.recordings, &others);
        Ok(Some(out))
    }
}

/// Says in which recordings the causes are there.
fn tell(out: &mut Diagnosis, some: &[Run], others: &[Run]) {
    let names = |runs: &[Run]| runs.iter().map(|run| format!("'{}'", run.name)).collect::<Vec<_>>().join(", ");
    let whole = |run: &Run| {
        let from = run.from;
        (run.name.clone(), vec![[from, from + run.period * run.torque.len() as f64]])
    };
    let intervals: BTreeMap<String, Vec<[f64; 2]>> = some.iter().map(whole).collect();
    let causes = out.ranked.iter_mut().filter(|c| c.magnitude.is_some());
    causes.for_each(|cause| _ = cause.intervals.get_or_insert_with(|| intervals.clone()));
    let sentence = format!(
        "This is so in {} of the recordings: {}. In the others, {}, the calibrated simulation is right; nothing explains all of them \
         together, and no figure below is about these.",
        some.len(),
        names(some),
        names(others)
    );
    let told =
        out.sentences.iter().rposition(|s| s.starts_with("Missing")).map_or(out.sentences.len().min(1), |k| k + 1);
    out.sentences.insert(told, sentence);
}

#[cfg(test)]
mod tests {
    use inference::hypothesis::{Dose, Place, Variant, variants};
    use testing::robot;

    use crate::testing::driven;
    use crate::{Case, Run, diagnose};
    use inference::Options;
    use verdict::Verdict;

    #[test]
    fn a_load_that_was_put_on_for_some_drives_is_told_with_these() {
        let is_payload = |v: &Variant| v.spec().id == "payload" && v.place == Place::Whole;
        let payload = variants(true).into_iter().find(is_payload).expect("in the catalogue");
        let drive = |name: &str, doses: &[Dose], seconds: f64| {
            let run = driven(&robot(), doses, seconds);
            Run { name: name.to_owned(), ..run }
        };
        let loaded = [payload.dose(&[6.0], None)];
        let references = vec![drive("a", &[], 20.0), drive("b", &[], 24.0), drive("c", &[], 22.0)];
        let recordings = vec![
            drive("empty", &[], 18.0),
            drive("laden", &loaded, 20.0),
            drive("empty again", &[], 21.0),
            drive("laden again", &loaded, 22.0),
        ];
        let case = Case { references, recordings, ..Case::new(robot()) };
        let d = diagnose(&case, &Options::default(), &|_| {}).expect("a diagnosis");
        assert_eq!((d.verdict, d.ranked[0].effect.as_str()), (Verdict::Explained, "payload"), "{:?}", d.sentences);
        assert!((d.ranked[0].magnitude.expect("a size") - 6.0).abs() < 0.3, "{:?}", d.ranked[0]);
        assert!(
            d.sentences[1].starts_with("This is so in 2 of the recordings: 'laden', 'laden again'."),
            "{:?}",
            d.sentences
        );
        let intervals = d.ranked[0].intervals.as_ref().expect("recordings");
        assert_eq!(intervals.keys().collect::<Vec<_>>(), ["laden", "laden again"]);
    }
}

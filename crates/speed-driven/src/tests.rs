//! Whole diagnoses: what leads the answer, and that nothing below contradicts it.

use verdict::{Diagnosis, Quantity, Ratio, Verdict};

use crate::testing::{Leg, diagnosis, rounds};

fn ratio(d: &Diagnosis, quantity: Quantity) -> &Ratio {
    let loads = d.steady.as_ref().expect("loads");
    loads.ratios.iter().find(|r| r.quantity == quantity).expect("a ratio")
}

fn is_alike(r: &Ratio) -> bool {
    r.interval[0] <= 1.0 && 1.0 <= r.interval[1]
}

#[test]
fn the_references_drive_again_is_no_mismatch() {
    let d = diagnosis(&[&rounds(3)]);
    assert_eq!(d.verdict, Verdict::NoMismatch, "{:?}", d.sentences);
    assert!(d.sentences[0].starts_with("No mismatch"), "{:?}", d.sentences);
}

#[test]
fn a_body_that_stands_leads_the_answer_and_its_rows_touch_nothing_else() {
    let stuck = Leg { scrub: 60.0, turned: 0.05, ..Leg::turn(20.0) };
    let d = diagnosis(&[&[rounds(3), vec![stuck], rounds(1)].concat()]);
    assert_eq!((d.verdict, d.ranked[0].effect.as_str()), (Verdict::Explained, "standing"), "{:?}", d.ranked);
    assert!(d.sentences[0].starts_with("Standing: in 0 from 120."), "{:?}", d.sentences);
    assert!(d.ranked.iter().all(|c| c.effect != "none" || c.probability < 0.02), "{:?}", d.ranked);
    for quantity in [Quantity::StraightLoad, Quantity::TurningLoad, Quantity::EffectiveTrack] {
        assert!(is_alike(ratio(&d, quantity)), "{:?}", ratio(&d, quantity));
    }
    let loads = d.steady.expect("loads");
    assert_eq!(loads.turning_changes, []);
    // Forecasts of what moves are no worse for it.
    for f in loads.forecasts {
        assert!(f.corrected < f.retuned, "{f:?}");
    }
}

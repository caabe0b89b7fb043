//! What an answer leaves open, in sentences.

use catalogue::for_people;
use inference::evidence::logistic;
use inference::words::probability;

use crate::found::Answer;
use crate::settings::SETTINGS;
use crate::telling::Found;

impl Found<'_> {
    /// How an answer begins by which nothing is missing; where that is open, as it has been said, what follows is no more than that.
    pub(crate) fn nothing(&self) -> &'static str {
        if self.undecided().is_some() {
            "If nothing is missing,"
        } else if self.doubt() > 0.0 {
            "Nothing that can be named is missing:"
        } else {
            "Nothing is missing:"
        }
    }

    /// What is left of the recordings beside the references, where that is more than usual.
    pub(crate) fn doubted(&self) -> Option<String> {
        if self.doubt() <= 0.0 {
            return None;
        }
        let Some([left, usual]) = self.beside_references else {
            return self.beside_usual.map(|[left, usual]| {
                format!(
                    "Yet {:.1} % of the motion are left, and sound robots leave less than {:.1} %: not enough to be called missing. Look where \
                     the drives differ from the simulation.",
                    100.0 * left,
                    100.0 * usual
                )
            });
        };
        Some(format!(
            "Yet {:.1} % of the motion are left of the recordings and {:.1} % of the references, {:.1} times as much: more than what is \
             usual, and not enough to be called missing. Look at where they differ.",
            100.0 * left,
            100.0 * usual,
            left / usual.max(f64::MIN_POSITIVE)
        ))
    }

    /// Causes that are likelier than not, beside those that are named, and not sure enough for it.
    pub(crate) fn perhaps(&self) -> Option<String> {
        let likely = self.others.iter().filter(|(_, p)| self.answer == Answer::Named && *p > 0.5);
        let told: Vec<String> = likely.map(|(l, p)| format!("{} ({})", for_people(l), probability(*p))).collect();
        (!told.is_empty()).then(|| {
            format!(
                "Perhaps also, with a probability in brackets below the {} from which a cause is named: {}.",
                probability(logistic(SETTINGS.naming.named)),
                told.join(", ")
            )
        })
    }

    /// What leads where no cause is named and yet one is likelier than none.
    pub(crate) fn undecided(&self) -> Option<String> {
        if !matches!(self.answer, Answer::Nothing | Answer::Retune) {
            return None;
        }
        let none = self.nothing_else();
        let (label, best) = self.others.iter().max_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, p)| *p > none)?;
        // A constant that moved is wrong in the file or on the robot, whatever more drives show.
        let decides = if self.answer == Answer::Retune {
            "Measure the constants below that moved farthest, or record drives in which the simulation is right, to decide."
        } else {
            "Record more drives to decide."
        };
        Some(format!(
            "These drives do not tell whether anything is missing: {} has a probability of {}, nothing one of {}. {decides}",
            for_people(label),
            probability(*best),
            probability(none)
        ))
    }
}

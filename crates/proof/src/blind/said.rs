//! What a verdict of constants says, in its own words: for kinds whose causes are directions of constants.

use serde_json::Value;

/// Above this probability a cause is named.
const LIKELY: f64 = 0.5;
/// Half width of a 90 % interval, in sigmas.
const NINETY: f64 = 1.645;

/// A verdict; null is a refusal.
pub(super) struct Said<'a> {
    diagnosis: &'a Value,
    /// Labels of the causes that are named.
    pub(super) named: Vec<String>,
    classes: Vec<Vec<String>>,
}

impl<'a> Said<'a> {
    pub(super) fn new(diagnosis: &'a Value) -> Self {
        let is_cause = |c: &&Value| !["none", "unknown"].contains(&c["effect"].as_str().unwrap_or_default());
        let named = likely(diagnosis).filter(is_cause).map(|c| text(&c["name"])).collect();
        let members = |class: &Value| class.as_array().map_or(&[][..], Vec::as_slice).iter().map(text).collect();
        let classes = list(diagnosis, "indistinguishable").iter().map(members).collect();
        Self { diagnosis, named, classes }
    }

    /// As it says it; "refused" without one.
    pub(super) fn verdict(&self) -> String {
        self.diagnosis["verdict"].as_str().unwrap_or("refused").to_owned()
    }

    pub(super) fn headline(&self) -> String {
        list(self.diagnosis, "sentences").first().map(text).unwrap_or_default()
    }

    /// Whether a label is something, or is of the class of one that is: a class stands for each of its members.
    pub(super) fn stands_for(&self, label: &str, is: impl Fn(&str) -> bool) -> bool {
        let class = self.classes.iter().find(|class| class.iter().any(|l| l == label));
        is(label) || class.is_some_and(|class| class.iter().any(|other| is(other)))
    }

    /// Error of a number that is told of a named cause, over half of its 90 % interval.
    pub(super) fn error(&self, parameter: &str, truth: f64, is_size: bool) -> Option<f64> {
        let told = likely(self.diagnosis).find_map(|c| c["parameters"].get(parameter))?;
        let half = told["sigma"].as_f64().filter(|sigma| *sigma > 0.0)? * NINETY;
        let value = told["value"].as_f64()?;
        Some((if is_size { value.abs() } else { value } - truth) / half)
    }

    /// Error of forecasts of what was left out, those whose quantity begins so: corrected over as stated.
    pub(super) fn forecast(&self, quantity: &str) -> Option<f64> {
        let ahead = list(self.diagnosis, "free_runs")
            .iter()
            .filter(|f| f["quantity"].as_str().is_some_and(|q| q.starts_with(quantity)));
        let [corrected, stated] = ahead.fold([0.0, 0.0], |[a, b], f| {
            [a + f["corrected"].as_f64().unwrap_or(f64::NAN), b + f["nominal"].as_f64().unwrap_or(f64::NAN)]
        });
        Some(corrected / stated).filter(|share| share.is_finite())
    }
}

/// The id of a label, and the wheel or distance that it is about.
pub(super) fn id_of(label: &str) -> (&str, Option<&str>) {
    label.split_once(" (").map_or((label, None), |(id, of)| (id, Some(of.trim_end_matches(')'))))
}

fn likely(d: &Value) -> impl Iterator<Item = &Value> {
    list(d, "ranked").iter().filter(|c| c["probability"].as_f64().is_some_and(|p| p > LIKELY))
}

fn list<'a>(v: &'a Value, key: &str) -> &'a [Value] {
    v[key].as_array().map_or(&[], Vec::as_slice)
}

fn text(v: &Value) -> String {
    v.as_str().unwrap_or_default().to_owned()
}

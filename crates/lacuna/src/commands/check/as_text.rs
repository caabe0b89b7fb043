//! What was found, for people.

use case_files::check::{Checked, Mapped, Proposed, Used};
use pages::text_table::{TextTable, number};
use recordings::{Contents, Field, Severity};

use super::{of_robot, stamps, tables};
use crate::commands::listed;
use crate::console::heading;

pub(super) fn render(c: &Checked, fields: bool) -> String {
    let mut out = String::new();
    for (name, contents) in &c.bags {
        out += &bag(name, contents, fields);
    }
    out.extend(c.tables.iter().map(tables::text));
    match &c.mapping {
        Used::Named(name) => out += &format!("\nMapping: {name}.\n"),
        Used::BuiltIn(name) => out += &format!("\nThe built-in mapping {name} fits these recordings.\n"),
        Used::Proposed { bag, inferred } => {
            out += &format!(
                "\nNo built-in mapping fits. One was proposed for {bag}, by message types and joint names, and is used below.\n"
            );
            if c.proposed.is_none() {
                out += "For a diagnosis have it written with --write-mapping FILE and look through it.\n";
                out += &listed("Inferred", inferred);
            }
        }
        Used::RobotFile => out.extend(c.of_robot.iter().map(of_robot::text)),
        Used::Nothing(_) if !c.tables.is_empty() => {
            out += "\nNo built-in mapping fits, and of a table nobody but you knows which column is which signal, in which \
                    unit and with which sign. Say it in a mapping (--write-mapping writes its skeleton) and give it with \
                    --mapping.\n";
        }
        Used::Nothing(why) => {
            out += "\nNo built-in mapping fits, so that nobody knows which field is which signal. Write one that names them \
                    (--fields lists the fields, --write-mapping proposes one) and give it with --mapping.\n";
            out += &why.as_ref().map(|why| format!("Tried: {why}\n")).unwrap_or_default();
        }
    }
    if let Some(Proposed { file, inferred, is_skeleton }) = &c.proposed {
        out += &if let Used::RobotFile = c.mapping {
            format!("\nRobot file proposed: {file}. Use it with --robot {file}, after a look at what was inferred.\n")
        } else if *is_skeleton {
            format!(
                "\nSkeleton of a mapping: {file}. Say in it which column is which signal, then use --mapping {file}.\n"
            )
        } else {
            format!("\nMapping proposed: {file}. Use it with --mapping {file}, after a look at what was inferred.\n")
        };
        out += &listed("Inferred", inferred);
    }
    for recording in &c.recordings {
        out += &channels(recording);
    }
    let same: Vec<String> = c.same.iter().map(|group| group.join(" and ")).collect();
    out += &listed("The same data, whatever the file", &same);
    out += &listed("Lost", &c.lost);
    out.trim_start().to_owned()
}

fn bag(name: &str, contents: &Contents, fields: bool) -> String {
    let mut table = TextTable::new(&["topic", "type", ">messages", ">Hz", ">from s", ">to s", ">numeric fields"]);
    let start = contents.topics.iter().map(|t| t.log_time_ns.0).min().unwrap_or(0);
    let mut trouble = Vec::new();
    let mut listing = String::new();
    for topic in &contents.topics {
        let (from, to) = topic.log_time_ns;
        let seconds = |t: i64| (t - start) as f64 * 1e-9;
        let span = seconds(to) - seconds(from);
        let rate = if span > 0.0 { number((topic.count - 1) as f64 / span) } else { "-".into() };
        let (count, shown) = match &topic.fields {
            Ok(fields) => (fields.len().to_string(), fields.as_slice()),
            Err(why) => {
                trouble.push(format!("{}: {why}", topic.name));
                ("-".into(), &[][..])
            }
        };
        if topic.undecodable > 0 {
            trouble.push(format!("{}: {} messages do not decode by their schema", topic.name, topic.undecodable));
        }
        table.row([
            topic.name.clone(),
            topic.message_type.clone(),
            topic.count.to_string(),
            rate,
            format!("{:.2}", seconds(from)),
            format!("{:.2}", seconds(to)),
            count,
        ]);
        if fields {
            for field in shown {
                listing += &format!("  {}.{}{}\n", topic.name, field.path, items(field));
            }
        }
    }
    let mut out = format!("\n{}{}", heading(name), table.render());
    out += &format!("  {} bytes, SHA-256 {}\n", contents.bytes, contents.sha256);
    if fields {
        out += &format!("\n{}{listing}", heading("Fields"));
    }
    let stamped: Vec<String> = contents.topics.iter().filter_map(stamps::sentence).collect();
    out += &listed("Header stamps", &stamped);
    out + &listed("Not decoded", &trouble)
}

/// What a list holds, as a mapping addresses it.
fn items(field: &Field) -> String {
    match field.lengths {
        None => String::new(),
        Some((_, 0)) => "[] (always empty)".to_owned(),
        Some(_) if !field.names.is_empty() => format!("[{}]", field.names.join(" | ")),
        Some((_, most)) => format!("[0 .. {}]", most - 1),
    }
}

fn channels(recording: &Mapped) -> String {
    let mut table = TextTable::new(&[
        "signal",
        "column",
        ">samples",
        ">Hz",
        ">jitter ms",
        ">gaps",
        ">longest s",
        ">step",
        ">noise",
        "unit",
    ]);
    let mut findings = Vec::new();
    for channel in &recording.channels {
        let (q, t) = (&channel.quality, &channel.quality.timing);
        let some = |v: Option<f64>| v.map_or_else(|| "-".to_owned(), number);
        table.row([
            channel.name.clone(),
            channel.column.clone(),
            t.samples.to_string(),
            some(t.rate_hz()),
            number(t.jitter_mad_s * 1e3),
            t.gaps.tally.count.to_string(),
            number(t.gaps.longest_s),
            some(q.grid.map(|g| g.step)),
            some(q.noise),
            channel.unit.to_owned(),
        ]);
        let told = q.findings(channel.unit).into_iter().filter(|f| f.severity > Severity::Note);
        findings.extend(told.map(|f| format!("{}: {f}", channel.name)));
    }
    let heading = heading(&recording.name);
    let (worth, permits) = (listed("Worth a look", &findings), listed("Diagnoses", &recording.permits));
    format!("\n{heading}{}{worth}{permits}", table.render())
}

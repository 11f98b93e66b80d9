//! The map as text: what is sure stands as it is, what is guessed says why, what only the lab knows is `"?"`.

use std::fmt::Write;

use super::frames::{self, FrameLines};
use super::joins::{self, SeenJoin};
use super::path_parts::PathParts;
use super::roles::{Role, channel, words};
use super::survey::FileGroup;
use super::tables::{SeenColumn, SeenTable};
use crate::import::converter;
use crate::source_folder::SourceFolder;
use taceva_dataset::internal::is_attribute_name;

const HEAD: &str = "\
# A draft: made from names, headers and the first rows. Every \"?\" is to be filled in; an import refuses it and names its line.
# Lines with \"a guess\" may be wrong. `taceva import FOLDER --map THIS --explain` says what would be read.
map_version = 2
";

/// How many things that are not read a draft names.
const UNREAD: usize = 8;

/// Why a file is not read, and what reads it.
pub(super) fn refused_form(group: &FileGroup) -> Option<String> {
    let remedy = converter(group.first())?;
    Some(format!("{} is not read: {remedy}", group.first()))
}

/// That a preset is made for what lies here.
pub(super) fn known_layout(preset: &str) -> String {
    format!(
        "This looks like the layout of `--preset {preset}`, which needs no map: `taceva import --presets` says what it reads."
    )
}

/// The map of a folder whose samples are the rows of `main`.
pub(super) fn of_table(
    folder: &SourceFolder,
    groups: &[FileGroup],
    main: &SeenTable<'_>,
    tables: &[SeenTable<'_>],
    notes: &[String],
) -> String {
    let frame = frames::of(folder, groups, main, tables);
    let joins = joins::of(main, tables);
    let mut text = begun(notes);
    line(
        &mut text,
        &format!("table = {}   # {} rows", main.written, main.rows),
    );
    if let Some(guess) = &main.header_guess {
        line(&mut text, guess);
    }
    if !main.others.is_empty() {
        let others = main.others.join(", ");
        line(&mut text, &format!("# Other pictures in it: {others}"));
    }
    for reason in main.unread.iter().take(UNREAD) {
        line(
            &mut text,
            &format!("# Not read: {}", reason.replace('\n', " ")),
        );
    }
    let others: Vec<&str> = tables
        .iter()
        .map(|table| table.group.pattern())
        .filter(|path| *path != main.group.pattern())
        .collect();
    if !others.is_empty() {
        line(&mut text, &format!("# Other tables: {}", others.join(", ")));
    }
    let parts = (main.group.paths.len() > 1).then_some(&main.group.parts);
    if let Some(parts) = parts {
        add_path(&mut text, parts);
    }
    add_frame(&mut text, frame.as_ref());
    let columns = table_columns(main, &joins);
    let mut channels = Lines::default();
    let mut attributes = Lines::default();
    for NamedColumn { name, role, doubt } in &columns {
        match role {
            Role::Channels(found) if doubt.is_none() => {
                add_channels(&mut channels, name, found, "")
            }
            Role::Channels(_) => {}
            _ if main.classes.iter().any(|(column, _)| column == name) => {}
            Role::Attribute => attributes.add(&attribute_name(name), &format!("{name:?}")),
            Role::Time { .. } | Role::Index | Role::Number | Role::Other => {}
        }
    }
    let mut ids = Lines::default();
    if let Some(parts) = parts {
        add_parts(parts, &mut channels, &mut ids, &mut attributes);
        let mut counted = parts
            .names
            .iter()
            .filter(|(name, is_number)| *is_number && name.starts_with("number"));
        if let Some((name, _)) = counted.next() {
            ids.add("repeat", &format!("\"path.{name}\"   # a guess"));
        }
    }
    // What was commanded or predicted stands behind whatever was measured.
    for NamedColumn { name, role, doubt } in &columns {
        if let (Role::Channels(found), Some(doubt)) = (role, doubt) {
            add_channels(&mut channels, name, found, &format!("   # {doubt}"));
        }
    }
    if main.has_groups() {
        attributes.add("group", "\"group\"");
    }
    let own_taxels = main.own_taxels();
    let numbers: Vec<&str> = columns
        .iter()
        .filter(|NamedColumn { name, role, .. }| {
            let is_taxel =
                own_taxels.is_some() && main.columns.iter().any(|column| column.name == *name);
            *role == Role::Number && !is_taxel
        })
        .map(|column| column.name.as_str())
        .collect();
    let mut joined = joins.iter().map(|join| join.table.has_guessed_channels);
    if main.has_guessed_channels || joined.any(|is_guessed| is_guessed) {
        channels.0.insert_str(
            0,
            "# A guess: three or six numbers without a header are mostly these, in this order.\n",
        );
    }
    let numbers = match numbers.is_empty() {
        true => String::new(),
        false => format!(
            "# Numbers whose names say nothing: {}\n",
            numbers.join(", ")
        ),
    };
    add_section(&mut text, "columns", &format!("{numbers}{}", channels.0));
    match main.time() {
        Some(time) => {
            let clock = if time.is_unix { "unix" } else { "monotonic" };
            let lines = format!(
                "clock = {clock:?}   # a guess by the size of the times\ncolumn = {:?}\nunit = {:?}{}\n",
                time.column.name,
                time.unit,
                time.mark()
            );
            add_section(&mut text, "time", &lines);
        }
        None => add_section(&mut text, "time", "clock = \"unknown\"\n"),
    }
    for join in &joins {
        let guess = join.table.header_guess.iter();
        let lines = guess.chain(&join.lines);
        let lines: String = lines.map(|line| format!("{line}\n")).collect();
        add_section(
            &mut text,
            "[join]",
            &format!("name = {:?}\ntable = {}\n{lines}", join.name, join.written),
        );
    }
    add_section(&mut text, "ids", &ids.0);
    add_section(&mut text, "attributes", &attributes.0);
    let mut classes = Lines::default();
    for (column, names) in &main.classes {
        let names: Vec<String> = names.iter().map(|name| format!("{name:?}")).collect();
        classes.add(
            &attribute_name(column),
            &format!("{{ from = {column:?}, names = [{}] }}", names.join(", ")),
        );
    }
    add_section(&mut text, "classes", &classes.0);
    let mut taxels = tables
        .iter()
        .filter(|table| table.rows == main.rows && table.written != main.written);
    let beside = |table: &SeenTable<'_>| {
        let from = format!("{{ file = {:?} }}", table.group.first());
        Some((from, table.taxels()?))
    };
    if let Some((from, count)) = own_taxels.or_else(|| taxels.find_map(beside)) {
        add_section(&mut text, "signals", &signals(&from, count));
    }
    ended(text)
}

/// Taxels: so many numbers a row.
fn signals(from: &str, count: usize) -> String {
    let (places, channels) = match count % 3 {
        0 => (count / 3, "[\"x\", \"y\", \"z\"]"),
        _ => (count, "[\"value\"]"),
    };
    let side = places.isqrt();
    let grid = match side > 1 && side * side == places {
        true => format!("[{side}, {side}]"),
        false => format!("[{places}, 1]"),
    };
    format!(
        "from = {from}\nunit = \"?\"\nplaces = {grid}   # a guess: rows and columns of the grid\nchannels = {channels}   # a guess\norder = \"place-first\"   # a guess: x y z x y z …\n"
    )
}

/// The map of a folder of pictures without a table.
pub(super) fn of_files(group: &FileGroup, notes: &[String]) -> String {
    let mut text = begun(notes);
    line(
        &mut text,
        &format!(
            "table = {{ files = {:?} }}   # no table: {} files, each of them a row",
            group.pattern(),
            group.paths.len()
        ),
    );
    let (mut channels, mut ids, mut attributes) =
        (Lines::default(), Lines::default(), Lines::default());
    if group.parts.names.is_empty() {
        line(
            &mut text,
            "# Nothing varies in their names that could be a label.",
        );
    } else {
        add_path(&mut text, &group.parts);
        add_parts(&group.parts, &mut channels, &mut ids, &mut attributes);
    }
    add_frame(
        &mut text,
        Some(&FrameLines {
            lines: vec!["column = \"file\"".to_owned()],
            ..FrameLines::default()
        }),
    );
    if channels.0.is_empty()
        && let Some((name, words)) = group.parts.words.first()
    {
        let names: Vec<String> = words.iter().map(|word| format!("{word:?}")).collect();
        let class = format!(
            "class = {{ from = \"path.{name}\", names = [{}] }}   # a guess: nothing else could be a label\n",
            names.join(", ")
        );
        add_section(&mut text, "classes", &class);
        attributes.0.clear();
    }
    add_section(&mut text, "columns", &channels.0);
    add_section(&mut text, "time", "clock = \"unknown\"\n");
    add_section(&mut text, "ids", &ids.0);
    add_section(&mut text, "attributes", &attributes.0);
    ended(text)
}

/// A column as a map names it.
struct NamedColumn {
    name: String,
    role: Role,
    doubt: Option<String>,
}

/// The columns of the main table and of those that are joined.
fn table_columns(main: &SeenTable<'_>, joins: &[SeenJoin<'_, '_>]) -> Vec<NamedColumn> {
    let named = |name: String, column: &SeenColumn| NamedColumn {
        name,
        role: column.role.clone(),
        doubt: column.doubt.clone(),
    };
    let mut columns: Vec<NamedColumn> = main
        .columns
        .iter()
        .map(|column| named(column.name.clone(), column))
        .collect();
    for join in joins {
        let others = join.table.columns.iter();
        columns
            .extend(others.map(|column| named(format!("{}.{}", join.name, column.name), column)));
    }
    columns
}

/// A line for each channel that the column called `name` holds.
fn add_channels(lines: &mut Lines, name: &str, found: &[(&'static str, String)], mark: &str) {
    for (channel, index) in found {
        let value = format!("{{ from = \"{name}{index}\", unit = \"?\" }}{mark}");
        lines.add(channel, &value);
    }
}

/// What the parts of a path seem to be: channels by their names, a unit, texts.
fn add_parts(parts: &PathParts, channels: &mut Lines, ids: &mut Lines, attributes: &mut Lines) {
    for (name, is_number) in &parts.names {
        let from = format!("path.{name}");
        match (is_number, channel(&words(name))) {
            (true, Some(channel)) => {
                channels.add(channel, &format!("{{ from = {from:?}, unit = \"?\" }}"))
            }
            (true, None) if name.eq_ignore_ascii_case("unit") => {
                ids.add("unit_id", &format!("{from:?}"))
            }
            (true, None)
                if ["repeat", "rep", "trial"].contains(&name.to_ascii_lowercase().as_str()) =>
            {
                ids.add("repeat", &format!("{from:?}"))
            }
            (true, None) if name.starts_with("number") => {}
            _ => attributes.add(&attribute_name(name), &format!("{from:?}")),
        }
    }
}

/// Lines of a section, each key once.
#[derive(Default)]
struct Lines(String);

impl Lines {
    fn add(&mut self, key: &str, value: &str) {
        let is_known = self
            .0
            .lines()
            .any(|line| line.split(" = ").next() == Some(key));
        let mark = if is_known { "# or: " } else { "" };
        let _ = writeln!(self.0, "{mark}{key} = {value}");
    }
}

fn attribute_name(column: &str) -> String {
    // `/object/name` is the object, as `path.object` is.
    let mut parts = column
        .trim_start_matches('@')
        .rsplit(['/', '.'])
        .filter(|part| !["", "name", "id", "value", "text"].contains(part));
    let last = parts.next().unwrap_or(column);
    let name: String = last
        .chars()
        .map(|letter| {
            if letter.is_ascii_alphanumeric() {
                letter
            } else {
                '_'
            }
        })
        .collect();
    match is_attribute_name(&name) {
        true => name,
        false => format!("text_{name}"),
    }
}

fn begun(notes: &[String]) -> String {
    let mut text = HEAD.to_owned();
    for note in notes {
        line(&mut text, &format!("# {}", note.replace('\n', " ")));
    }
    text
}

fn add_path(text: &mut String, parts: &PathParts) {
    add_section(text, "path", &format!("pattern = {:?}\n", parts.pattern));
}

fn add_frame(text: &mut String, frame: Option<&FrameLines>) {
    let Some(frame) = frame else {
        line(text, "# No pictures were found that belong to its rows.");
        return;
    };
    let mut lines: String = frame.lines.iter().map(|line| format!("{line}\n")).collect();
    lines += match frame.is_gray {
        true => "channel_order = \"gray\"\n",
        false => {
            "channel_order = \"rgb\"   # a guess: OpenCV writes arrays as \"bgr\"; pictures without colours are \"gray\"\n"
        }
    };
    lines += "reference = \"unknown\"   # the picture without contact, if there is one\n";
    add_section(text, "frame", &lines);
}

fn add_section(text: &mut String, name: &str, lines: &str) {
    if !lines.is_empty() {
        let _ = write!(text, "\n[{name}]\n{lines}");
    }
}

fn ended(mut text: String) -> String {
    add_section(
        &mut text,
        "sensor",
        "model = \"?\"\nserial = \"unknown\"\ngel = \"unknown\"\nopaque = \"unknown\"\n",
    );
    text
}

fn line(text: &mut String, line: &str) {
    text.push_str(line);
    text.push('\n');
}

//! Map as text: certain lines as they are, guesses with a reason, and `"?"` for facts that only the lab knows.

use std::fmt::Write;

use super::channels::{self, Offered};
use super::clips;
use super::frames::{self, FrameLines};
use super::joins::{self, SeenJoin};
use super::path_parts::PathParts;
use super::roles::candidate::{Candidate, Named};
use super::roles::{Role, words};
use super::survey::FileGroup;
use super::tables::{SeenColumn, SeenTable, Taxels};
use crate::import::converter;
use crate::source_folder::SourceFolder;
use taceva_dataset::ChannelOrder;
use taceva_dataset::internal::is_attribute_name;

const HEAD: &str = "\
# A draft from names, headers and the first rows. Replace every \"?\": an import refuses it and names its line.
# Lines with \"a guess\" may be wrong. Check them with `taceva import FOLDER --map THIS --explain`.
map_version = 2
";

/// Limit of unread items that a draft names.
const UNREAD: usize = 8;

/// Note on an unreadable file, with a converter for it.
pub(super) fn refused_form(group: &FileGroup) -> Option<String> {
    let remedy = converter(group.first())?;
    Some(format!("{} is not read: {remedy}", group.first()))
}

/// Advice for clips without a table.
pub(super) fn bare_clips(clips: &FileGroup) -> String {
    let clip = clips.first();
    format!(
        "{clip} has frames, but no file here has labels: write a table beside it, such as labels.csv with the columns `frame` (from 0) \
         and `Fz`, and draft again (`video = {clip:?}`, `index = \"frame\"`); or write its frames as pictures, which need no table: \
         `ffmpeg -i {clip} %06d.png`"
    )
}

/// Note that a preset matches the folder.
pub(super) fn known_layout(preset: &str) -> String {
    format!(
        "This looks like the layout of `--preset {preset}`, which needs no map: `taceva import --presets` says what it reads."
    )
}

/// Comment on an array that is beside pictures but not a table of them.
pub(super) fn array_beside_pictures(table: &SeenTable<'_>) -> String {
    format!(
        "{} ({} rows) is no table of the pictures: if it is the picture without contact, save it as PNG and name it as `reference`.",
        table.group.pattern(),
        table.rows
    )
}

/// Map with one more comment at its beginning.
pub(super) fn with_note(text: &str, note: &str) -> String {
    match text.strip_prefix(HEAD) {
        Some(rest) => format!("{HEAD}# {note}\n{rest}"),
        None => text.to_owned(),
    }
}

/// Map of a folder whose samples are the rows of `main`.
pub(super) fn of_table(
    folder: &SourceFolder,
    groups: &[FileGroup],
    main: &SeenTable<'_>,
    tables: &[SeenTable<'_>],
    notes: &[String],
) -> String {
    let mut frames = frames::of(folder, main, tables);
    if frames.is_empty() {
        frames = clips::of(folder, groups, main);
    }
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
    } else if let Some(path) = frames.iter().find_map(|frame| frame.path.as_ref()) {
        add_section(&mut text, "path", path);
    }
    add_frames(&mut text, &frames);
    let columns = table_columns(main, &joins);
    let mut attributes = Lines::default();
    for NamedColumn { name, role, .. } in &columns {
        let is_class = main.classes.iter().any(|(column, _)| column == name);
        if **role == Role::Attribute && !is_class {
            attributes.add(&attribute_name(name), &format!("{name:?}"));
        }
    }
    let mut ids = Lines::default();
    let mut of_path = Vec::new();
    if let Some(parts) = parts {
        of_path = add_parts(parts, &mut ids, &mut attributes);
        let mut counted = parts
            .names
            .iter()
            .filter(|(name, is_number)| *is_number && name.starts_with("number"));
        if let Some((name, _)) = counted.next() {
            ids.add("repeat", &format!("\"path.{name}\"   # a guess"));
        }
    }
    if main.has_groups() {
        attributes.add("group", "\"group\"");
    }
    let offered = columns.iter().flat_map(|column| {
        let candidates = match column.role {
            Role::Channels(candidates) => candidates.as_slice(),
            _ => &[],
        };
        candidates.iter().map(|candidate| Offered {
            name: &column.name,
            candidate,
            is_own: column.is_own,
        })
    });
    let of_path = of_path.iter().map(|(name, candidate)| Offered {
        name,
        candidate,
        is_own: true,
    });
    let offered: Vec<Offered<'_>> = offered.chain(of_path).collect();
    let mut channels = channels::lines(&offered);
    let own_taxels = main.own_taxels();
    let numbers: Vec<String> = columns
        .iter()
        .filter(|column| {
            !(column.is_own && own_taxels.iter().any(|taxels| taxels.holds(&column.name)))
        })
        .filter_map(|column| match column.role {
            Role::Number => Some(column.name.clone()),
            Role::Numbers(count) => Some(format!("{} ({count} numbers)", column.name)),
            _ => None,
        })
        .collect();
    let excluded: Vec<String> = columns
        .iter()
        .filter_map(|column| match column.role {
            Role::Excluded(why) => Some(format!("{} ({why})", column.name)),
            _ => None,
        })
        .collect();
    let mut joined = joins.iter().map(|join| join.table.has_guessed_channels);
    if main.has_guessed_channels || joined.any(|is_guessed| is_guessed) {
        channels.insert_str(
            0,
            "# A guess: three or six numbers without a header are mostly these, in this order.\n",
        );
    }
    let mut comments = String::new();
    for (said, names) in [
        ("Numbers with unknown names", numbers),
        ("No channels", excluded),
    ] {
        if !names.is_empty() {
            let _ = writeln!(comments, "# {said}: {}", shortened(&names));
        }
    }
    add_section(&mut text, "columns", &format!("{comments}{channels}"));
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
    let shared = shared_points(main, parts);
    add_section(&mut text, "ids", &format!("{}{shared}", ids.0));
    add_section(&mut text, "attributes", &attributes.0);
    if let Some(drop) = frames.iter().find_map(|frame| frame.drop.as_ref()) {
        add_section(&mut text, "drop", drop);
    }
    let mut classes = Lines::default();
    for (column, names) in &main.classes {
        let names: Vec<String> = names.iter().map(|name| format!("{name:?}")).collect();
        classes.add(
            &attribute_name(column),
            &format!("{{ from = {column:?}, names = [{}] }}", names.join(", ")),
        );
    }
    add_section(&mut text, "classes", &classes.0);
    let beside = tables
        .iter()
        .filter(|table| table.rows == main.rows && table.written != main.written)
        .filter_map(|table| {
            let from = format!("{{ file = {:?} }}", table.group.first());
            Some(Taxels {
                from,
                ..table.taxels()?
            })
        });
    let mut taxels = own_taxels.into_iter().chain(beside);
    if let Some(first) = taxels.next() {
        let others: Vec<String> = taxels.map(|other| other.from).collect();
        add_section(&mut text, "signals", &signals(&first, &others));
    }
    ended(text)
}

/// Words of columns whose equal values mark rows that belong together.
const SHARED: [&str; 12] = [
    "episode", "session", "trial", "object", "video", "clip", "take", "press", "run", "repeat",
    "grasp", "sequence",
];

/// Line of the shared point of repeats: active for episodes, commented out for others.
fn shared_points(main: &SeenTable<'_>, parts: Option<&PathParts>) -> String {
    let is_shared = |name: &str| {
        let words = words(name);
        words.iter().any(|word| SHARED.contains(&word.as_str()))
    };
    let several = |column: &&SeenColumn| {
        let mut values: Vec<&String> = column
            .cells
            .iter()
            .filter(|cell| !cell.is_empty())
            .collect();
        let filled = values.len();
        values.sort_unstable();
        values.dedup();
        values.len() * 2 <= filled
    };
    let mut columns = main.columns.iter().filter(|column| is_shared(&column.name));
    if let Some(episode) = columns
        .clone()
        .find(|column| column.name == "episode_index")
    {
        return format!(
            "point_id = {:?}   # a guess: groups the rows of an episode, for intervals and --split by-point\n",
            episode.name
        );
    }
    if let Some(column) = columns.find(several) {
        return format!(
            "# point_id = {:?}   # groups repeats, for intervals and --split by-point\n",
            column.name
        );
    }
    let Some(parts) = parts.filter(|_| main.rows > 1) else {
        return String::new();
    };
    let names: Vec<String> = parts
        .names
        .iter()
        .map(|(name, _)| format!("\"path.{name}\""))
        .collect();
    match names.is_empty() {
        true => String::new(),
        false => format!(
            "# point_id = [{}]   # groups the rows of a file if they share a contact or a session, for intervals and --split by-point\n",
            names.join(", ")
        ),
    }
}

/// Limit of columns that a comment names.
const NAMED: usize = 24;

fn shortened(names: &[String]) -> String {
    let more = match names.len().saturating_sub(NAMED) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    let names: Vec<&str> = names.iter().take(NAMED).map(String::as_str).collect();
    format!("{}{more}", names.join(", "))
}

/// Lines of taxels. `others` are alternative columns.
fn signals(taxels: &Taxels, others: &[String]) -> String {
    let names = |count: usize| match count {
        1 => "[\"value\"]".to_owned(),
        count if count <= 3 => format!("{:?}", &["x", "y", "z"][..count]),
        count => {
            let names: Vec<String> = (0..count).map(|at| format!("v{at}")).collect();
            format!("{names:?}")
        }
    };
    let square = |places: usize| {
        let side = places.isqrt();
        match side > 1 && side * side == places {
            true => [side, side],
            false => [places, 1],
        }
    };
    let count = taxels.count();
    let (grid, channels, is_channel_first) = match taxels.shape[..] {
        [places, channels] if channels <= 6 => (square(places), channels, false),
        [channels, places] if channels <= 3 => (square(places), channels, true),
        [rows, columns] => ([rows, columns], 1, false),
        [rows, columns, channels] if channels <= 6 => ([rows, columns], channels, false),
        [channels, rows, columns] if channels <= 6 => ([rows, columns], channels, true),
        _ if count.is_multiple_of(3) => (square(count / 3), 3, false),
        _ => (square(count), 1, false),
    };
    let mut text = match others {
        [] => String::new(),
        others => format!("# or: from = {}\n", shortened(others)),
    };
    let unit = match taxels.unit {
        Some(unit) => format!("{unit:?}   # by its name"),
        None => "\"?\"".to_owned(),
    };
    let order = match is_channel_first {
        true => "\"channel-first\"   # a guess: x x … y y … z z …",
        false => "\"place-first\"   # a guess: x y z x y z …",
    };
    let _ = writeln!(
        text,
        "from = {}\nunit = {unit}\nplaces = {grid:?}   # a guess: rows and columns of the grid\nchannels = {}   # a guess\norder = {order}",
        taxels.from,
        names(channels),
    );
    if !taxels.placeholders.is_empty() {
        let codes: Vec<String> = taxels
            .placeholders
            .iter()
            .map(|(code, _)| code.to_string())
            .collect();
        let reasons = taxels
            .placeholders
            .iter()
            .map(|(_, reason)| reason.as_str());
        let reasons: Vec<&str> = reasons.collect();
        let _ = writeln!(
            text,
            "placeholders = [{}]   # a guess: codes of missing readings: {}",
            codes.join(", "),
            reasons.join("; ")
        );
    }
    text
}

/// Map of a folder of pictures without a table.
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
    let (mut ids, mut attributes) = (Lines::default(), Lines::default());
    let mut of_path = Vec::new();
    if group.parts.names.is_empty() {
        line(
            &mut text,
            "# Their names have no varying part that could be a label.",
        );
    } else {
        add_path(&mut text, &group.parts);
        of_path = add_parts(&group.parts, &mut ids, &mut attributes);
    }
    let offered: Vec<Offered<'_>> = of_path
        .iter()
        .map(|(name, candidate)| Offered {
            name,
            candidate,
            is_own: true,
        })
        .collect();
    let channels = channels::lines(&offered);
    let frames = FrameLines {
        lines: vec!["column = \"file\"".to_owned()],
        ..FrameLines::default()
    };
    add_frames(&mut text, &[frames]);
    if channels.is_empty()
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
    add_section(&mut text, "columns", &channels);
    add_section(&mut text, "time", "clock = \"unknown\"\n");
    add_section(&mut text, "ids", &ids.0);
    add_section(&mut text, "attributes", &attributes.0);
    ended(text)
}

/// Column named as in a map.
struct NamedColumn<'t> {
    name: String,
    role: &'t Role,
    /// True for a column of the main table.
    is_own: bool,
}

/// Columns of the main table and of joined tables.
fn table_columns<'t>(
    main: &'t SeenTable<'_>,
    joins: &'t [SeenJoin<'_, '_>],
) -> Vec<NamedColumn<'t>> {
    let named = |name: String, column: &'t SeenColumn, is_own: bool| NamedColumn {
        name,
        role: &column.role,
        is_own,
    };
    let mut columns: Vec<NamedColumn<'_>> = main
        .columns
        .iter()
        .map(|column| named(column.name.clone(), column, true))
        .collect();
    for join in joins {
        let others = join.table.columns.iter();
        columns.extend(
            others.map(|column| named(format!("{}.{}", join.name, column.name), column, false)),
        );
    }
    columns
}

/// Sorts the parts of a path into ids and attributes. Returns the channels among them.
fn add_parts(
    parts: &PathParts,
    ids: &mut Lines,
    attributes: &mut Lines,
) -> Vec<(String, Candidate)> {
    let mut candidates = Vec::new();
    for (name, is_number) in &parts.names {
        let from = format!("path.{name}");
        let named = match parts.letters_behind(name) {
            Some(letters) => Named::new(&format!("{name} ({letters})")),
            None => Named::new(name),
        };
        match (is_number, named.candidate(String::new())) {
            (true, Some(Ok(candidate))) => candidates.push((from, candidate)),
            (true, _) if name.eq_ignore_ascii_case("unit") => {
                ids.add("unit_id", &format!("{from:?}"))
            }
            (true, _)
                if ["repeat", "rep", "trial"].contains(&name.to_ascii_lowercase().as_str()) =>
            {
                ids.add("repeat", &format!("{from:?}"))
            }
            (true, _) if name.starts_with("number") => {}
            _ => attributes.add(&attribute_name(name), &format!("{from:?}")),
        }
    }
    candidates
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
    // `/object/name` becomes `object`, as `path.object` does.
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

fn add_frames(text: &mut String, frames: &[FrameLines]) {
    if frames.is_empty() {
        line(text, "# No pictures were found that belong to its rows.");
    }
    for frame in frames {
        add_frame(text, frame);
    }
}

fn add_frame(text: &mut String, frame: &FrameLines) {
    let name = frame.view.iter();
    let name = name.map(|view| format!("name = {view:?}   # a guess: each row has this view; for a single picture write [frame] without a \
        name\n"));
    let lines = frame.lines.iter().map(|line| format!("{line}\n"));
    let mut lines: String = name.chain(lines).collect();
    lines += match (frame.is_gray, frame.order) {
        (_, Some(ChannelOrder::Bgr)) => "channel_order = \"bgr\"   # stated by the messages\n",
        (_, Some(ChannelOrder::Rgb)) => "channel_order = \"rgb\"   # stated by the messages\n",
        (true, _) | (_, Some(ChannelOrder::Gray)) => "channel_order = \"gray\"\n",
        (false, _) => {
            "channel_order = \"rgb\"   # a guess: OpenCV writes arrays as \"bgr\"; pictures without colours are \"gray\"\n"
        }
    };
    lines += "reference = \"unknown\"   # the picture without contact, if there is one\n";
    let section = frame.view.as_ref().map_or("frame", |_| "[frame]");
    add_section(text, section, &lines);
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

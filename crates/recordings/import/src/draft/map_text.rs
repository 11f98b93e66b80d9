//! Text of a drafted map: certain lines, guesses with a reason, and `"?"` for facts that only the lab knows.

mod clip;
mod column_lists;
mod ids;
mod sections;
mod signals;
mod tasks;

use super::channels::{self, Offered};
use super::clips;
use super::frames::{self, FrameLines};
use super::joins::{self, SeenJoin};
use super::path_parts::PathParts;
use super::roles::Role;
use super::roles::candidate::Candidate;
use super::survey::FileGroup;
use super::tables::{SeenTable, Taxels};
use crate::source_folder::SourceFolder;
pub(super) use clip::of_clip;
use column_lists::lists;
use ids::{add_parts, attribute_name, group_points, repeat_column, shared_points};
use sections::{HEAD, Lines, add_frames, add_path, add_section, begun, ended, line};
use signals::signals;
use taceva_core::counted;

/// Maximum number of unread items of a file that a draft names.
const UNREAD: usize = 8;

/// Maximum number of columns that a comment names.
const NAMED: usize = 24;

/// Map with an additional comment at its beginning.
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
    let mut frames = frames::of(folder, groups, main, tables);
    if frames.is_empty() {
        frames = clips::of(folder, groups, main);
    }
    let parts = (main.group.paths.len() > 1).then_some(&main.group.parts);
    let (joins, unused) = used_joins(main, joins::of(main, tables), parts);
    let mut text = begun(notes);
    line(
        &mut text,
        &format!("table = {}   # {}", main.written, counted(main.rows, "row")),
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
    if !unused.is_empty() {
        line(
            &mut text,
            &format!(
                "# Not joined, because no line below uses a column of these tables: {}",
                unused.join(", ")
            ),
        );
    }
    if let Some(parts) = parts {
        add_path(&mut text, parts);
    } else if let Some(path) = frames.iter().find_map(|frame| frame.path.as_ref()) {
        add_section(&mut text, "path", path);
    }
    if frames.is_empty() {
        line(&mut text, &frames::none_found(groups, main));
    }
    add_frames(&mut text, &frames);
    let columns = table_columns(main, &joins);
    let mut attributes = attribute_lines(main, &columns);
    let mut ids = Lines::default();
    if let Some(column) = repeat_column(main) {
        ids.add("repeat", &format!("{column:?}   # by its name"));
    }
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
    let offered = offered(&columns, &of_path);
    let mut channels = channels::lines(&offered);
    let own_taxels = main.own_taxels();
    let is_free = |column: &&NamedColumn<'_>| {
        let is_taxel = |taxels: &Taxels| taxels.holds(&column.name);
        !(column.is_own && own_taxels.iter().any(is_taxel))
    };
    let free: Vec<&NamedColumn<'_>> = columns.iter().filter(is_free).collect();
    let mut joined = joins.iter().map(|join| join.table.has_guessed_channels);
    if main.has_guessed_channels || joined.any(|is_guessed| is_guessed) {
        channels.insert_str(
            0,
            "# A guess: three or six numbers without a header are mostly the channels below, in this order.\n",
        );
    }
    let mut rest = String::new();
    match main.time() {
        Some(time) => {
            let clock = if time.is_unix { "unix" } else { "monotonic" };
            let lines = format!(
                "clock = {clock:?}   # a guess by the size of the times\ncolumn = {:?}\nunit = {:?}{}\n",
                time.column.name,
                time.unit,
                time.mark()
            );
            add_section(&mut rest, "time", &lines);
        }
        None => add_section(&mut rest, "time", "clock = \"unknown\"\n"),
    }
    for join in &joins {
        let guess = join.table.header_guess.iter();
        let lines = guess.chain(&join.lines);
        let lines: String = lines.map(|line| format!("{line}\n")).collect();
        add_section(
            &mut rest,
            "[join]",
            &format!("name = {:?}\ntable = {}\n{lines}", join.name, join.written),
        );
    }
    let shared = shared_points(main, parts, &channels);
    let groups = group_points(main);
    add_section(&mut rest, "ids", &format!("{}{groups}{shared}", ids.0));
    add_section(&mut rest, "attributes", &attributes.0);
    if let Some(drop) = frames.iter().find_map(|frame| frame.drop.as_ref()) {
        add_section(&mut rest, "drop", drop);
    }
    let mut classes = Lines::default();
    for (column, names) in &main.classes {
        let names: Vec<String> = names.iter().map(|name| format!("{name:?}")).collect();
        classes.add(
            &attribute_name(column),
            &format!("{{ from = {column:?}, names = [{}] }}", names.join(", ")),
        );
    }
    add_section(&mut rest, "classes", &classes.0);
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
        add_section(&mut rest, "signals", &signals(&first, &others));
    }
    let lines = [text.as_str(), channels.as_str(), rest.as_str()].concat();
    let keys: String = joins
        .iter()
        .flat_map(|join| &join.lines)
        .map(String::as_str)
        .collect();
    let comments = lists(&free, &lines, &keys);
    add_section(&mut text, "columns", &format!("{comments}{channels}"));
    text.push_str(&rest);
    if let Some(comment) = tasks::suggestion(columns.iter().map(|column| column.name.as_str())) {
        line(&mut text, &comment);
    }
    ended(text)
}

/// Map of a folder of pictures without a table.
pub(super) fn of_files(group: &FileGroup, notes: &[String]) -> String {
    let mut text = begun(notes);
    line(
        &mut text,
        &format!(
            "table = {{ files = {:?} }}   # no table: {}, each of them a row",
            group.pattern(),
            counted(group.paths.len(), "file")
        ),
    );
    let (mut ids, mut attributes) = (Lines::default(), Lines::default());
    ids.add(
        "sample",
        "\"file\"   # results and predictions name the pictures",
    );
    let mut of_path = Vec::new();
    if group.parts.names.is_empty() {
        line(
            &mut text,
            "# The names of the pictures have no varying part that could be a label.",
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
    let time = match &group.parts.stamp {
        Some(stamp) => format!(
            "clock = \"unix\"   # a guess by the size of the numbers\ncolumn = \"path.{}\"\nunit = {:?}\n",
            stamp.name, stamp.unit
        ),
        None => "clock = \"unknown\"\n".to_owned(),
    };
    add_section(&mut text, "time", &time);
    add_section(&mut text, "ids", &ids.0);
    add_section(&mut text, "attributes", &attributes.0);
    ended(text)
}

/// Splits the joins `found`: first the joins that an uncommented line of the map uses, then the values of `table` of the other joins.
fn used_joins<'t, 'g>(
    main: &SeenTable<'_>,
    found: Vec<SeenJoin<'t, 'g>>,
    parts: Option<&PathParts>,
) -> (Vec<SeenJoin<'t, 'g>>, Vec<String>) {
    let active = {
        let columns = table_columns(main, &found);
        let of_path = parts.map(|parts| {
            let (mut ids, mut attributes) = (Lines::default(), Lines::default());
            add_parts(parts, &mut ids, &mut attributes)
        });
        let channels = channels::lines(&offered(&columns, &of_path.unwrap_or_default()));
        let lines = channels + &attribute_lines(main, &columns).0;
        let active = lines.lines().filter(|line| !line.starts_with('#'));
        active.map(str::to_owned).collect::<Vec<_>>()
    };
    let is_used = |join: &SeenJoin<'_, '_>| {
        let column = format!("\"{}.", join.name);
        active.iter().any(|line| line.contains(&column))
    };
    let (used, unused): (Vec<_>, Vec<_>) = found.into_iter().partition(is_used);
    (used, unused.into_iter().map(|join| join.written).collect())
}

/// Candidates for channels in columns and in parts of paths.
fn offered<'t>(
    columns: &'t [NamedColumn<'t>],
    of_path: &'t [(String, Candidate)],
) -> Vec<Offered<'t>> {
    let of_columns = columns.iter().flat_map(|column| {
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
    of_columns.chain(of_path).collect()
}

/// Lines of `[attributes]` for columns that contain texts.
fn attribute_lines(main: &SeenTable<'_>, columns: &[NamedColumn<'_>]) -> Lines {
    let mut attributes = Lines::default();
    for column in columns {
        let name = &column.name;
        let is_class = main.classes.iter().any(|(class, _)| class == name);
        if *column.role == Role::Attribute && !is_class && !column.is_interpolated {
            attributes.add(&attribute_name(name), &format!("{name:?}"));
        }
    }
    attributes
}

/// Column with its name in a map.
struct NamedColumn<'t> {
    name: String,
    role: &'t Role,
    /// True for a column of the main table.
    is_own: bool,
    /// True if the cells are numbers interpolated between two rows of a joined table.
    is_interpolated: bool,
}

/// Columns of the main table and of joined tables.
fn table_columns<'t>(
    main: &'t SeenTable<'_>,
    joins: &'t [SeenJoin<'_, '_>],
) -> Vec<NamedColumn<'t>> {
    let own = main.columns.iter().map(|column| NamedColumn {
        name: column.name.clone(),
        role: &column.role,
        is_own: true,
        is_interpolated: false,
    });
    let joined = joins.iter().flat_map(|join| {
        let is_interpolated = join.is_interpolated();
        join.table.columns.iter().map(move |column| NamedColumn {
            name: format!("{}.{}", join.name, column.name),
            role: &column.role,
            is_own: false,
            is_interpolated,
        })
    });
    own.chain(joined).collect()
}

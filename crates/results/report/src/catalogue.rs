//! Catalogue of sensors: construction, limits and published numbers, each with its source.

mod alike;
mod builtin;
mod bundle_row;
mod bundle_study;
mod definition;
mod entry;
mod facts;
mod list;
mod lookup;
mod offer;
mod published;
mod question;
mod read;
mod study;
mod union;

pub use bundle_row::{ADDRESS, DEPTHS, Measured, Origin, is_address, row_lines, rows_text};
pub(crate) use bundle_row::{DEPTH_NOTE, short};
pub use entry::{Kind, Sensor};
pub use facts::{Limits, Size};
pub(crate) use list::{MECHANISMS, prices};
pub use list::{details, list, listed_as};
pub use lookup::{NameError, named};
pub use offer::{Availability, Goods, Price, Way};
pub use published::{Missing, Published, Roughly, Source};
pub use question::Question;
pub use read::CatalogueError;
pub(crate) use study::RESULT;
pub use union::{joined, named_among};

/// Built-in sensors and studies, by name.
///
/// ```
/// let sensors = taceva_report::catalogue::all();
/// let gelsight = sensors.iter().find(|sensor| sensor.name == "GelSight").expect("there");
/// assert_eq!(gelsight.result("mae", "Pz").map(|result| result.value), Some(0.0325));
/// ```
///
/// # Panics
/// Never: a test reads every file.
pub fn all() -> Vec<Sensor> {
    let read = |(file, text): &(&str, &str)| {
        Sensor::read(file, text).expect("a test reads every file of the catalogue")
    };
    let mut sensors: Vec<Sensor> = builtin::FILES.iter().map(read).collect();
    sensors.sort_by_key(|sensor| sensor.name.to_lowercase());
    sensors
}

/// Sensor called `name`, or the only sensor with that alias; ignores case. `None` if there is no such sensor.
pub fn find(name: &str) -> Option<Sensor> {
    named(name).ok()
}

/// Hint for a `name` that the catalogue lacks.
pub fn hint(name: &str) -> String {
    match nearest(name) {
        Some(nearest) => format!("did you mean `{nearest}`? `taceva catalogue list` shows all"),
        None => match names_alike(name).as_slice() {
            [] => "`taceva catalogue list` shows all".to_owned(),
            names => format!(
                "names that begin alike: {}; `taceva catalogue list` shows all",
                names.join(", ")
            ),
        },
    }
}

/// Number of equal first letters of similar names.
const ALIKE: usize = 3;

/// Names of entries that begin with the first letters of `name`.
fn names_alike(name: &str) -> Vec<String> {
    let start = |name: &str| name.to_lowercase().chars().take(ALIKE).collect::<String>();
    let wanted = start(name);
    let names = all().into_iter().map(|entry| entry.name);
    names
        .filter(|own| wanted.chars().count() == ALIKE && start(own) == wanted)
        .collect()
}

/// The most similar name or alias in the catalogue, if any is similar.
///
/// ```
/// assert_eq!(taceva_report::catalogue::nearest("gelsigt").as_deref(), Some("GelSight"));
/// assert_eq!(taceva_report::catalogue::nearest("banana"), None);
/// ```
pub fn nearest(name: &str) -> Option<String> {
    let names: Vec<String> = all()
        .into_iter()
        .flat_map(|entry| [vec![entry.name], entry.aliases].concat())
        .collect();
    taceva_core::nearest(name, names.iter().map(String::as_str)).map(str::to_owned)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;
    use std::path::Path;

    use super::*;

    #[test]
    fn every_file_of_the_folder_is_read_and_says_where_its_numbers_are_from() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("catalogue");
        let files: BTreeSet<String> = std::fs::read_dir(folder)
            .expect("the folder")
            .map(|entry| {
                entry
                    .expect("readable")
                    .file_name()
                    .to_string_lossy()
                    .into_owned()
            })
            .collect();
        let listed: BTreeSet<String> = builtin::FILES
            .iter()
            .map(|(file, _)| (*file).to_owned())
            .collect();
        assert_eq!(files, listed);
        for (file, text) in builtin::FILES {
            let sensor = Sensor::read(file, text).unwrap_or_else(|error| panic!("{error}"));
            let size = sensor.size.iter().map(|size| &size.source);
            let prices = sensor.prices.iter().map(|price| &price.source);
            let ways = sensor.availability.iter().map(|offer| &offer.source);
            for source in size.chain(prices).chain(ways) {
                assert!(sensor.source(source).is_some(), "{file}: {source}");
            }
            for result in &sensor.results {
                assert!(
                    sensor.source(&result.source).is_some(),
                    "{file}: {}",
                    result.source
                );
                assert!(
                    !result.conditions.is_empty() && !result.definition.is_empty(),
                    "{file}"
                );
            }
        }
    }

    #[test]
    fn a_name_that_is_like_none_gets_those_that_begin_alike() {
        let hint = hint("gelsite");
        assert!(hint.contains("GelSight, GelSightWM"), "{hint}");
        assert_eq!(super::hint("banana"), "`taceva catalogue list` shows all");
    }

    #[test]
    fn every_row_of_every_entry_has_a_definition_and_conditions() {
        for sensor in all() {
            for row in details(&sensor).rows {
                let cells = row.plain();
                assert!(
                    !cells[5].is_empty() && !cells[6].is_empty(),
                    "{}: {cells:?}",
                    sensor.name
                );
            }
        }
    }

    #[test]
    fn a_size_or_a_price_counts_among_the_known_numbers() {
        let count = |name: &str| find(name).expect("there").known();
        assert_eq!(count("AnySkin"), 1);
        let digit = find("DIGIT").expect("there");
        assert_eq!(digit.known(), digit.results.len() + 2, "size and a price");
    }

    #[test]
    fn the_list_shows_sizes_prices_and_ways_to_get_a_sensor_and_explains_its_words() {
        let table = list(&all());
        let row = table
            .rows
            .iter()
            .map(|row| row.plain())
            .find(|row| row[0] == "DIGIT");
        let row = row.expect("listed");
        assert_eq!(
            row[8..11],
            ["20 × 27 × 18", "15 USD (parts)", "bought; built"]
        );
        for words in ["IMM: ", "MDM: ", "MFM: ", "GelSightWM: ", "not converted"] {
            assert!(
                table.notes.iter().any(|note| note.plain().contains(words)),
                "{words}"
            );
        }
    }

    #[test]
    fn a_page_of_numbers_says_whose_publication_reports_what_and_by_which_source() {
        let text = details(&find("GelSight").expect("there")).text();
        let expected = "Reported in GelSight's own publication, says source `page` (no): ";
        assert!(text.contains(expected), "{text}");
        assert!(text.contains("is inferred from the data sheet"), "{text}");
    }

    #[test]
    fn the_four_sensors_of_the_study_are_there_in_full() {
        for name in ["ViTacTip", "MagicTac", "GelSight", "GelSightWM"] {
            let sensor = find(name).expect("there");
            for metric in ["mae", "r2", "smape", "r_spatial"] {
                for channel in crate::variables::VARIABLES {
                    assert!(
                        sensor.result(metric, channel).is_some(),
                        "{name} {metric} {channel}"
                    );
                }
            }
            assert!(sensor.limits.is_some() && sensor.frame_rate_hz().is_some());
        }
    }

    #[test]
    fn at_least_twelve_sensors_have_a_number_with_its_source() {
        let known = all()
            .into_iter()
            .filter(|entry| entry.kind == Kind::Sensor && entry.known() > 0);
        let names: Vec<String> = known.map(|sensor| sensor.name).collect();
        assert!(names.len() >= 12, "{names:?}");
    }

    #[test]
    fn a_number_of_another_definition_cannot_take_the_name_of_a_metric() {
        let entry = |metric: &str, definition: &str| {
            let text = format!(
                "catalogue_version = 1\nname = \"x\"\nkind = \"sensor\"\nmechanism = []\n[[result]]\nmetric = \"{metric}\"\nchannel = \"Fz\"\n\
                 value = 0.1\nunit = \"N\"\nsource = \"s\"\nread_from = \"text\"\nconditions = \"c\"\ndefinition = \"{definition}\"\n"
            );
            Sensor::read("x.toml", &text)
        };
        let error = entry("mae", "median error").expect_err("another definition");
        assert!(error.to_string().contains("median error"), "{error}");
        assert!(entry("drift", "per day").is_err());
        assert!(entry("median_error", "median error").is_ok());
    }

    #[test]
    fn an_entry_of_version_2_may_call_its_published_numbers_so() {
        let text = "catalogue_version = 2\nname = \"x\"\nkind = \"sensor\"\nmechanism = []\n[[published]]\nmetric = \"force_error\"\nchannel = \"F\"\n\
                    value = 0.1\nunit = \"N\"\nsource = \"s\"\nread_from = \"text\"\nconditions = \"c\"\ndefinition = \"d\"\n";
        let sensor = Sensor::read("x.toml", text).expect("an entry");
        assert_eq!(sensor.results.len(), 1);
        assert!(sensor.has_published() && !sensor.has_bundles());
    }

    #[test]
    fn what_is_only_about_a_number_is_shown_and_not_compared() {
        let thin = find("ThinTact").expect("there");
        assert_eq!(thin.result("intrinsic", "field_of_view"), None);
        assert_eq!(thin.results[0].shown(), "> 200");
        assert!(thin.as_study().scores.is_empty());
    }

    #[test]
    fn a_key_that_nobody_knows_is_refused_by_its_line() {
        let error = Sensor::read(
            "x.toml",
            "catalogue_version = 1\nname = \"x\"\nkind = \"sensor\"\nmechanism = []\ncolour = 1\n",
        );
        let error = error.expect_err("unknown key").to_string();
        assert!(
            error.contains("x.toml") && error.contains("colour"),
            "{error}"
        );
    }
}

//! Arguments of `taceva catalogue`.

use std::path::PathBuf;

use clap::{Args, Subcommand};
use taceva_bundle::{MOST_BYTES, Organization};
use taceva_report::catalogue::{ADDRESS, is_address};

use super::Output;

#[derive(Debug, Args)]
pub(crate) struct CatalogueArgs {
    #[command(subcommand)]
    pub(crate) subject: CatalogueSubject,
}

/// Operation on the catalogue.
#[derive(Debug, Subcommand)]
pub(crate) enum CatalogueSubject {
    /// List every sensor
    List(CatalogueList),
    /// Show the numbers of one sensor, each with its source
    Show(CatalogueShow),
    /// Write the catalogue as pages: a list to filter and sort, and one page for each sensor
    Site(CatalogueSite),
    Add(CatalogueAdd),
    /// Check the catalogue in a folder without a network, and write its index; the exit code is 1 if there is a finding
    Check(CatalogueCheckArgs),
    Export(CatalogueExport),
}

#[derive(Debug, Args)]
pub(crate) struct CatalogueList {
    /// The folder of a catalogue, whose sensors are listed too, each with its number of values from bundles
    #[arg(long, value_name = "DIR")]
    pub(crate) catalogue: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) output: Output,
}

#[derive(Debug, Args)]
pub(crate) struct CatalogueShow {
    /// The name of the sensor or an alias, such as "GelSight Mini"; `taceva catalogue list` prints all names
    pub(crate) name: String,
    /// The folder of a catalogue, whose numbers are printed after the published numbers; each number states the level of its verification
    #[arg(long, value_name = "DIR")]
    pub(crate) catalogue: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) output: Output,
}

#[derive(Debug, Args)]
pub(crate) struct CatalogueSite {
    /// The folder of a catalogue, whose numbers are shown beside the published ones
    #[arg(value_name = "DIR")]
    pub(crate) catalogue: Option<PathBuf>,
    /// The folder to write the pages into
    #[arg(long = "out", value_name = "FOLDER")]
    pub(crate) folder: PathBuf,
    /// Results of this program to show apart from published ones; may be repeated
    #[arg(long, value_name = "RESULT")]
    pub(crate) results: Vec<PathBuf>,
    /// Replace pages that exist already
    #[arg(long)]
    pub(crate) force: bool,
}

/// Verify a bundle at the deepest level that its files allow, and add its numbers to the catalogue in a folder
///
/// The catalogue is a folder with `entries/`, one file for each sensor, and `bundles/`, the manifests. Numbers go into `[[measured]]` if their
/// samples are recorded, into `[[simulated]]` if their samples are simulated or synthetic, else into `[[unknown]]`. Published numbers stay as they
/// are. A draft is refused, and so is a bundle whose results the catalogue already has. The exit code is 1 for a bundle that is not verified, and 3
/// for a damaged or refused bundle.
#[derive(Debug, Args)]
pub(crate) struct CatalogueAdd {
    /// The bundle: a folder, or a .tar.gz
    pub(crate) bundle: PathBuf,
    /// The folder of the catalogue, created if missing
    #[arg(long = "to", value_name = "DIR")]
    pub(crate) catalogue: PathBuf,
    /// The public address of the bundle
    #[arg(long, value_name = "URL", value_parser = address)]
    pub(crate) url: Option<String>,
    /// The maximum size of all files of the bundle together, in bytes
    #[arg(long, value_name = "BYTES", default_value_t = MOST_BYTES)]
    pub(crate) most: u64,
}

#[derive(Debug, Args)]
pub(crate) struct CatalogueCheckArgs {
    /// The folder of the catalogue
    #[arg(value_name = "DIR")]
    pub(crate) catalogue: PathBuf,
    /// A local bundle to verify again; its manifest must be in the catalogue; may be repeated
    #[arg(long = "bundle", value_name = "BUNDLE")]
    pub(crate) bundles: Vec<PathBuf>,
    #[command(flatten)]
    pub(crate) output: Output,
}

/// Write the catalogue in a folder as files for the Hugging Face Hub, Croissant or RO-Crate
///
/// The files hold only numbers of bundles, not published numbers. Write them again after `taceva catalogue add`.
#[derive(Debug, Args)]
pub(crate) struct CatalogueExport {
    /// The folder of the catalogue
    #[arg(value_name = "DIR")]
    pub(crate) catalogue: PathBuf,
    /// Write eval.yaml and .eval_results/SENSOR.yaml, for the Hugging Face Hub, into this folder
    #[arg(long = "hf", value_name = "FOLDER")]
    pub(crate) hub: Option<PathBuf>,
    /// Write croissant.json into the folder of the catalogue, with the digest of each of its files
    #[arg(long)]
    pub(crate) croissant: bool,
    /// Write ro-crate-metadata.json into the folder of the catalogue, with the digest of each of its files
    #[arg(long = "crate")]
    pub(crate) ro_crate: bool,
    /// The organization that publishes the catalogue
    #[arg(long, value_name = "NAME <URL>")]
    pub(crate) organization: Option<Organization>,
    /// Replace files that exist already
    #[arg(long)]
    pub(crate) force: bool,
}

/// Parses the address of a bundle.
fn address(text: &str) -> Result<String, String> {
    match is_address(text) {
        true => Ok(text.to_owned()),
        false => Err(format!("expected {ADDRESS}")),
    }
}

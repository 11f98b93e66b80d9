//! Names of the files of a bundle, and the limits of its readers.

/// File with the manifest, written last and sealed.
pub(crate) const MANIFEST: &str = "bundle.json";
/// File with the results of the bundle.
pub(crate) const RESULTS: &str = "results.json";
/// File with the digest of the samples.
pub(crate) const SAMPLES: &str = "samples.json";
/// File that describes the machine on which the bundle was made.
pub(crate) const ENVIRONMENT: &str = "environment.json";
/// File with the card for readers.
pub(crate) const CARD: &str = "README.md";
/// File with the citation.
pub(crate) const CITATION: &str = "CITATION.cff";
/// File with the licence.
pub(crate) const LICENCE: &str = "LICENSE";
/// File with the claims for the Hugging Face Hub.
pub(crate) const EVAL_RESULTS: &str = ".eval_results/taceva.yaml";
/// File with the description as a Croissant.
pub(crate) const CROISSANT: &str = "croissant.json";
/// File with the description as an RO-Crate.
pub(crate) const CRATE: &str = "ro-crate-metadata.json";
/// Files generated from the manifest.
pub(crate) const GENERATED: [&str; 6] = [CARD, CITATION, LICENCE, EVAL_RESULTS, CROISSANT, CRATE];
/// File with the header of a dataset.
pub(crate) const HEADER: &str = "dataset.toml";
/// Role of the header of a dataset.
pub(crate) const HEADER_ROLE: &str = "dataset";
/// Folder of recordings with pictures.
pub(crate) const FRAMES: &str = "frames";
/// Role of the files of recordings with pictures.
pub(crate) const FRAMES_ROLE: &str = "frames";
/// Role of a model file.
pub(crate) const MODEL_ROLE: &str = "model";
/// Optional text files of a bundle.
pub(crate) const TEXTS: [&str; 5] = [
    "scene.toml",
    "rig.toml",
    "map.toml",
    "limits.toml",
    "tasks.toml",
];

/// Maximum number of files in a bundle.
pub(crate) const MOST_FILES: usize = 4096;
/// Maximum number of files of recordings with pictures; 256 remain for the other files.
pub(crate) const MOST_FRAMES: usize = MOST_FILES - 256;
/// Default maximum size of all files together, bytes.
pub const MOST_BYTES: u64 = 2 << 30;
/// Maximum size of the manifest, bytes.
pub(crate) const MOST_MANIFEST: u64 = 8 << 20;
/// Maximum size of a text (JSON, TOML or Markdown), bytes.
pub(crate) const MOST_TEXT: u64 = 24 << 20;
/// Maximum size of all states of one study, bytes.
pub(crate) const MOST_STATES: u64 = 64 << 20;
/// Maximum size of a table, bytes.
pub(crate) const MOST_TABLE: u64 = 256 << 20;
/// Maximum size of a model file, bytes: the limit of its reader.
pub(crate) const MOST_MODEL: u64 = 256 << 20;
/// Maximum number of claims, and of scores in the results.
pub(crate) const MOST_CLAIMS: usize = 10_000;
/// Maximum number of authors.
pub(crate) const MOST_AUTHORS: usize = 1_000;
/// Maximum number of columns, over all tables, that `croissant.json` lists.
pub(crate) const MOST_COLUMNS: usize = 10_000;
/// Maximum length of a name, bytes.
pub(crate) const MOST_NAME: usize = 255;
/// Maximum number of parts of a name: its folders and the file.
pub(crate) const MOST_PARTS: usize = 8;
/// Maximum ratio of the unpacked to the packed size of a bundle, before [`GROWTH_BYTES`] is added.
pub(crate) const GROWTH: u64 = 128;
/// Unpacked size, bytes, that is allowed in addition to the ratio [`GROWTH`].
pub(crate) const GROWTH_BYTES: u64 = 64 << 20;

/// True if `name` is a file that `taceva bundle` writes, by its name or its folder.
pub(crate) fn is_own(name: &str) -> bool {
    let fixed = [MANIFEST, RESULTS, SAMPLES, ENVIRONMENT];
    let is_inner = ["states/", "tables/", "model/", "frames/"]
        .iter()
        .any(|own| name.starts_with(own));
    let is_fixed = fixed.contains(&name) || GENERATED.contains(&name);
    is_fixed || TEXTS.contains(&name) || is_inner || is_header(name)
}

/// True for the name of a header: `dataset.toml`, `dataset-2.toml`.
pub(crate) fn is_header(name: &str) -> bool {
    name.starts_with("dataset") && name.ends_with(".toml")
}

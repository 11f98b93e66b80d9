//! Catalogue that a community keeps in a folder: entries of sensors, and the manifests of the bundles behind their numbers.

mod addition;
mod bundle_check;
mod entry_place;
mod error;
mod export;
mod finding;
mod folder;
mod index;
mod inspection;
mod request;
mod row_check;
mod submission;

pub use addition::{Addition, add};
pub use bundle_check::check_bundles;
pub use error::CatalogueFolderError;
pub use export::{CatalogueForm, FormFile, catalogue_form};
pub use finding::CatalogueFinding;
pub use index::INDEX_SCHEMA;
pub use inspection::{CatalogueCheck, check_catalogue, entries, write_index};
pub use request::AddRequest;

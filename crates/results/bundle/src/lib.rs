#![doc = include_str!("../README.md")]

mod archive;
mod author;
mod card;
mod catalogue;
mod claim;
mod claim_list;
mod columns;
mod comparison;
mod croissant;
mod environment;
mod error;
mod eval_results;
mod form;
mod header;
mod inputs;
mod layout;
mod level;
mod licence;
mod make;
mod manifest;
mod model_card;
mod name;
mod operators;
mod organization;
mod origin;
mod recomputation;
mod redaction;
mod request;
mod ro_crate;
mod sample_digest;
mod source;
mod study_check;
mod table_facts;
mod texts;
mod verification;
mod verify;
mod writer;
mod yaml;

pub use author::Author;
pub use catalogue::{
    AddRequest, Addition, CatalogueCheck, CatalogueFinding, CatalogueFolderError, CatalogueForm,
    FormFile, INDEX_SCHEMA, add as add_to_catalogue, catalogue_form, check_bundles,
    check_catalogue, entries as catalogue_entries, write_index,
};
pub use claim::Claim;
pub use comparison::{
    BundleComparison, COMPARISON_SCHEMA, ClaimDifference, DefinitionDifference, compare,
};
pub use error::{BundleError, Damage};
pub use layout::MOST_BYTES;
pub use level::Level;
pub use licence::{expected_licence, is_licence};
pub use make::{MadeBundle, make};
pub use manifest::{BUNDLE_SCHEMA, BundledFile, Manifest, StudyFiles, TableFiles, Withheld};
pub use organization::Organization;
pub use redaction::{Redaction, redacted};
pub use request::{BundleRequest, ScoredTables};
pub use verification::{
    BundleFacts, ClaimCheck, LevelCheck, OtherCheck, Outcome, Summary, VERIFICATION_SCHEMA,
    Verdict, Verification,
};
pub use verify::{VerifyRequest, verify, verify_with};

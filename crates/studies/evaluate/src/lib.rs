#![doc = include_str!("../README.md")]

mod accumulate;
mod assess;
mod bounded_share;
mod cache;
mod calibration;
mod calibration_rows;
mod claim;
mod classifiers;
mod depth_pairs;
mod effort;
mod error;
mod evaluate;
mod features;
mod fit;
mod grouping;
mod mean_map;
mod merge;
mod neighbours;
mod note;
mod over_seeds;
mod plan;
mod pose_definition;
mod predict;
mod prediction_check;
mod prediction_files;
mod provenance;
mod recordings;
mod recount;
mod refit;
mod report;
mod rotation;
mod row_ledger;
mod rows;
mod run_layout;
mod samples;
mod score;
mod score_states;
mod sensor_facts;
mod skill;
mod state_file;
mod subject;
mod task_state_file;
mod task_view;
mod validation;
mod work;

pub use accumulate::{Columns, OF_SENSOR, Rows, accumulate};
pub use assess::{Assessed, Context, FitFacts, ScoredRows, assess};
pub use bounded_share::Bounded;
pub use cache::{
    Cache, CacheEntry, CachedStage, Kept, Key, KeyBuilder, Pruning, StageRecord, StudyCache,
    cache_entries, pruned, remove, remove_entry,
};
pub use calibration::calibration;
pub use claim::{Claim, Watch, clear_dead_claims};
pub use classifiers::{CLASSIFIERS, labelled_for, usual_model};
pub use effort::Effort;
pub use error::EvaluateError;
pub use evaluate::{
    Asked, BallPresses, Behind, EvaluateRequest, Evaluated, FoldedRows, GivenModel, GivenRequest,
    GivenRows, ModelChoice, PosePair, TaskRows, contact_shapes, evaluate, evaluate_plan,
    evaluate_pose_pairs, evaluate_task, evaluate_task_rows, fit_task, fold_divisions, score,
    scored_by_default, scored_of_task, task_division,
};
pub use features::{FeatureTable, blank, extract, extractor, feature_table};
pub use fit::{FitPlan, FitRequest, Fitted, Recipe, fit};
pub use merge::{merge, merge_read, side_by_side};
pub use neighbours::Resemblance;
pub use note::{
    Coverage, Detection, Division, FewClusters, Independence, Learning, Neighbours, Note, PairedBy,
    SampleOrder, Within,
};
pub use over_seeds::of as over_seeds;
pub use plan::{Plan, Step};
pub use predict::{
    AtBound, Predicted, Predictor, Target, model_extractor, predict, predict_target,
    predicted_numbers, predicted_table, truth,
};
pub use prediction_check::{PredictionCheck, check_predictions};
pub use prediction_files::{PredictionFiles, prediction_files};
pub use provenance::{choices, model as model_provenance, of as provenance_of};
pub use recordings::{depth_zeros, device_warnings, reduced};
pub use recount::{Recount, recount_phases, recount_samples};
pub use refit::{Refit, refit};
pub use report::skipped;
pub use row_ledger::Taken;
pub use rows::{DataPart, Divided, Need, require_samples, usable};
pub use run_layout::{MODELS, PLANS, RECORDINGS, STATES};
pub use samples::{add_division, add_predictions, of as samples_of, protocol as protocol_words};
pub use score::{
    Period, RowKey, ScoreRequest, ScoreTables, Scored, Scoring, Shard, ShardError, TaskRequest,
    TaskRule, TaskSpec, UNKNOWN_ORIGIN, read_table, recount_tables, score_in_one_pass,
    stated_origins, task_states,
};
pub use skill::{skill, with_skill};
pub use state_file::{ReadState, STATE_SCHEMA, StateFile};
pub use subject::of as subject_of;
pub use taceva_import::CsvTable;
pub use task_state_file::{TASK_STATE_SCHEMA, TaskStates, merge_task_states};
pub use validation::fit_validated;
pub use work::Work;

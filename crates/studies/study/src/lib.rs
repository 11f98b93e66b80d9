#![doc = include_str!("../README.md")]

mod accumulate;
mod acquire;
pub mod bench;
mod bounded;
mod cache;
mod calibration;
mod capture;
pub mod check;
mod claim;
mod classifier;
mod effort;
mod error;
mod evaluate;
mod facts;
mod features;
mod fit;
mod over_seeds;
mod plan;
mod planned_rows;
mod predict;
mod provenance;
mod recordings;
mod report;
mod rig;
mod rows;
mod run;
mod samples;
mod scene;
mod score;
mod skill;
mod stage;
mod state_file;
mod subject;
mod taken_rows;
mod viewer;
mod work;

pub use acquire::{
    AIR_MM, HeldRigs, RecordedSessions, Surroundings, SurroundingsOf, Upcoming, Workshop,
    rehearse_scene,
};
pub use cache::{
    Cache, CacheEntry, CachedStage, Pruning, StageRecord, cache_entries, pruned, remove_entry,
};
pub use capture::{
    CaptureRequest, CaptureStage, CaptureState, Captured, LiveDevices, LiveSpec, capture,
    close_capture, preview,
};
pub use check::{CheckReport, CheckRequest, Finding, Severity, check, check_plan};
pub use claim::{Claim, Watch, unique_name};
pub use effort::Effort;
pub use error::StudyError;
pub use evaluate::{
    EvaluateRequest, Evaluated, GivenModel, GivenRequest, GivenRows, ModelChoice, evaluate,
    evaluate_plan,
};
pub use features::{FeatureTable, feature_table};
pub use fit::{FitRequest, Fitted, fit};
pub use over_seeds::{OverSeeds, SeedScore};
pub use plan::{Plan, Step};
pub use predict::{Predicted, predict};
pub use provenance::{ModelProvenance, Provenance};
pub use recordings::RecordingProvenance;
pub use report::{EVALUATION_SCHEMA, EvaluationReport, RecordingScores};
pub use rig::{
    HaltTrip, RigCheck, RigProblem, RigTap, Stream, SwitchCheck, check_rig, read_rig, tap_rig,
    teach_rig,
};
pub use rows::{DataPart, Divided};
pub use run::{Existing, RunFolder, acquire_scene, run_scene};
pub use samples::Samples;
pub use scene::{Instead, PlannedScene, PlannedStudy, SceneText};
pub use score::{ScoreRequest, ScoreTables, Scored, Scoring, Shard, ShardError, score_in_one_pass};
pub use skill::with_skill;
pub use state_file::{STATE_SCHEMA, StateFile, merge};
pub use subject::Subject;
pub use viewer::Viewer;
pub use work::Work;

//! Tasks about telegrams, for lessons and for practice: what is asked, what is right, and what there is to say
//! to a wrong answer.
//!
//! | module | what it holds |
//! | --- | --- |
//! | [`task`] | what a task is |
//! | [`mod@grade`] | whether an answer is right, and which field is off in which way |
//! | [`lesson`] | lessons as text: reading them, and holding them to what the library says |
//! | [`notation`] | numbers as people write them |
//! | [`practice`] | tasks without end, made of a seed; [`random`] numbers for them |
//! | [`result`] | what came of a round, in eight letters |
//! | [`course`] | tasks for Moodle |
//! | [`fault`] | telegrams with a fault in them, for others to find; [`log`]s the same |
//! | [`set`] | tasks that somebody put together, as a text |
//!
//! It is made of what [`buslens::tool`] offers, in the words of [`buslens::field`], and so it can never be wrong
//! about a byte that the page shows.
#![forbid(unsafe_code)]

pub mod course;
pub mod fault;
pub mod grade;
pub mod lesson;
pub mod log;
pub mod notation;
pub mod practice;
pub mod random;
pub mod result;
pub mod set;
pub mod task;

pub use grade::{Answer, Remark, Verdict, grade};
pub use task::{Blank, Choice, Expected, Given, Number, Task, Telegram, letter};

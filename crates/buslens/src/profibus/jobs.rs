//! What a sequence of requests and confirmations of one parameter channel says: job after job.
//!
//! The channel is part of the cyclic data, so both sides repeat themselves: the master its request,
//! the slave its last confirmation. The handshake bit tells them apart: the master changes it for
//! each new job, and a confirmation counts when its handshake is that of the request. Until then it
//! is stale: the confirmation of the job before, shown once more.
//!
//! Source: KEB COMBIVERT F5 PROFIBUS-DP operator, 7.4 and 7.5.

use super::{Channel, Refusal, Service};
use crate::field::{Direction, Message, Problem, Span, hex_value};
use crate::message;

/// Follows the parameter channel of one slave, telegram after telegram.
///
/// ```
/// use buslens::field::Direction::{Request, Response};
/// use buslens::profibus::jobs::{Jobs, State};
/// use buslens::profibus::{Channel, Settings};
///
/// let mut jobs = Jobs::default();
/// let mut next = |direction, bytes: &[u8]| {
///     jobs.next(&Channel::read(bytes, direction, &Settings::default())).expect("a job")
/// };
/// let asked = next(Request, &[0x41, 0x00, 0x22, 0x00, 0, 0, 0, 0]);
/// assert_eq!((asked.job, asked.state), (1, State::Asked));
/// let done = next(Response, &[0x71, 0x00, 0x22, 0x00, 0, 0, 0, 0x46]);
/// assert_eq!((done.job, done.state, done.value), (1, State::Done, Some(70)));
/// ```
#[derive(Clone, Debug, Default)]
pub struct Jobs {
    /// How many jobs there have been.
    count: usize,
    job: Option<Job>,
    /// The request seen last.
    last: Option<Channel>,
    /// The confirmation that the slave shows until it has done the job.
    shown: Option<Channel>,
}

#[derive(Clone, Debug)]
struct Job {
    request: Channel,
    state: State,
}

/// What has become of a job.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// Requested; no confirmation since.
    Asked,
    /// The slave still shows the confirmation before.
    Running,
    Done,
    Failed,
}

impl State {
    /// The stable word of exports.
    pub const fn key(self) -> &'static str {
        match self {
            Self::Asked => "asked",
            Self::Running => "running",
            Self::Done => "done",
            Self::Failed => "failed",
        }
    }

    const fn finished(self) -> bool {
        matches!(self, Self::Done | Self::Failed)
    }
}

/// What one telegram means for the job that it belongs to.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// The job's number, from 1.
    pub job: usize,
    /// Of the job with this telegram: a repeated request of an unfinished job asks again.
    pub state: State,
    /// A request that says the same as the one before.
    pub repeated: bool,
    /// The value that was read or written, when it is done.
    pub value: Option<u32>,
    /// Why it failed.
    pub refusal: Option<Refusal>,
    /// What the telegram by itself cannot tell; the spans are those of the channel's 8 bytes.
    pub problems: Vec<Problem>,
}

impl Jobs {
    /// Takes the next telegram of the line. `None` where it belongs to no job: a request for no
    /// service, or a confirmation without a request before it.
    pub fn next(&mut self, channel: &Channel) -> Option<Step> {
        match channel.direction {
            Direction::Request => self.request(channel),
            Direction::Response => self.confirmation(channel),
        }
    }

    /// The request of the present job, for [`Body::answer`](super::Body::answer).
    pub fn job(&self) -> Option<&Channel> {
        self.job.as_ref().map(|job| &job.request)
    }

    fn request(&mut self, request: &Channel) -> Option<Step> {
        if request.service() == Service::None {
            self.job = None;
            self.last = None;
            return None;
        }
        let before = self.last.replace(request.clone());
        match (&mut self.job, before) {
            (Some(job), Some(before)) if before.handshake() == request.handshake() => {
                let repeated = asked(&before) == asked(request);
                if !job.state.finished() {
                    job.state = State::Asked;
                }
                let mut step = Step::new(self.count, job.state);
                step.repeated = repeated;
                if !repeated {
                    step.problems.push(Problem::error(
                        "handshake-not-changed",
                        CONTROL,
                        message!(
                            "this asks for something else than job {job}, but with the same handshake: \
                             the slave does not take it for a new job",
                            job = self.count
                        ),
                    ));
                }
                Some(step)
            }
            _ => Some(self.start(request)),
        }
    }

    fn start(&mut self, request: &Channel) -> Step {
        let before = self.job.replace(Job { request: request.clone(), state: State::Asked });
        self.count += 1;
        let mut step = Step::new(self.count, State::Asked);
        let shown = self.shown.as_ref().map(Channel::handshake);
        if before.is_some_and(|job| !job.state.finished()) {
            step.problems.push(Problem::warning(
                "job-not-finished",
                WHOLE,
                message!("job {job} was not finished when this one came", job = self.count - 1),
            ));
        } else if shown == Some(request.handshake()) {
            step.problems.push(Problem::error(
                "handshake-not-changed",
                CONTROL,
                message!(
                    "the slave already shows handshake {handshake}: it does not take this for a new job",
                    handshake = request.handshake()
                ),
            ));
        }
        step
    }

    fn confirmation(&mut self, confirmation: &Channel) -> Option<Step> {
        let Some(job) = &mut self.job else {
            self.shown = Some(confirmation.clone());
            return None;
        };
        let confirmation = confirmation.answering(&job.request);
        let counts = confirmation.handshake() == job.request.handshake();
        let finished = job.state.finished();
        if counts {
            job.state = if confirmation.refusal().is_some() { State::Failed } else { State::Done };
        } else if !finished {
            job.state = State::Running;
        }
        let mut step = Step::new(self.count, job.state);
        if counts {
            step.value = confirmation.value();
            step.refusal = confirmation.refusal();
            if !finished {
                step.problems.extend(mismatch(&job.request, &confirmation));
            }
        } else if let Some(shown) = &self.shown {
            step.problems.extend(match finished {
                true => lost(shown, &confirmation),
                false => stale(self.count, shown, &confirmation),
            });
        }
        // What a stale one shows otherwise does not change what should be shown.
        if counts || finished || self.shown.is_none() {
            self.shown = Some(confirmation);
        }
        Some(step)
    }
}

impl Step {
    fn new(job: usize, state: State) -> Self {
        Self { job, state, repeated: false, value: None, refusal: None, problems: Vec::new() }
    }
}

/// What a request asks for: what it carries beyond that is left over from before.
fn asked(request: &Channel) -> (Service, u16, u8, Option<usize>, Option<u32>) {
    (request.service(), request.index, request.subindex, request.length(), request.value())
}

/// What a confirmation that counts says otherwise than its request.
fn mismatch(request: &Channel, confirmation: &Channel) -> Option<Problem> {
    let named = |channel: &Channel| (channel.service(), channel.index, channel.subindex);
    // The slave may answer a forbidden service as it likes.
    if request.service() != Service::Both && named(request) != named(confirmation) {
        return Some(Problem::warning(
            "other-job",
            Span::new(0, 4),
            message!(
                "by its handshake this confirms the job, but the job was: {asked}; and this says: {confirmed}",
                asked = named_job(request),
                confirmed = named_job(confirmation)
            ),
        ));
    }
    match (request.value(), confirmation.value()) {
        (Some(asked), Some(written)) if asked != written => Some(Problem::warning(
            "written-otherwise",
            VALUE,
            message!("{asked} was to be written, {written} is confirmed", asked = asked, written = written),
        )),
        _ => None,
    }
}

fn named_job(channel: &Channel) -> Message {
    let place = channel.place();
    match channel.service() {
        Service::None => message!("nothing"),
        Service::Read => message!("read {place}", place = place),
        Service::Write => message!("write {place}", place = place),
        Service::Both => message!("read and write {place}", place = place),
    }
}

/// A handshake that changes although there is no new job.
fn lost(shown: &Channel, confirmation: &Channel) -> Option<Problem> {
    (shown.handshake() != confirmation.handshake()).then(|| {
        Problem::warning(
            "handshake-changed",
            CONTROL,
            message!("the slave changes its handshake without a new job: perhaps it has started again"),
        )
    })
}

/// How a stale confirmation differs from the one that it should repeat.
fn stale(job: usize, shown: &Channel, confirmation: &Channel) -> Option<Problem> {
    let bytes = confirmation.bytes().into_iter().zip(shown.bytes()).enumerate();
    let changed: Vec<(usize, (u8, u8))> = bytes.filter(|(_, (found, before))| found != before).collect();
    let span = Span::new(changed.first()?.0, changed.last()?.0 + 1);
    let said = Message::list(changed.into_iter().map(|(index, (found, before))| {
        message!(
            "byte {n} is {found} where it was {before}",
            n = index + 1,
            found = hex_value(found.into(), 1),
            before = hex_value(before.into(), 1)
        )
    }));
    said.map(|differences| {
        Problem::warning(
            "stale-otherwise",
            span,
            message!(
                "{differences}: as long as job {job} runs, the slave should repeat the confirmation before",
                differences = differences,
                job = job
            ),
        )
    })
}

/// Places within the channel.
const WHOLE: Span = Span::new(0, 8);
const CONTROL: Span = Span::new(0, 1);
const VALUE: Span = Span::new(4, 8);

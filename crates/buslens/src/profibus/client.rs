//! The master's side of the parameter channel, as the flow chart of the manual has it.
//!
//! The client does no IO and has no clock. In each cycle the caller sends [`Client::request`] as the
//! first 8 bytes of the output data and hands the first 8 bytes of the input data to
//! [`Client::receive`].
//!
//! A slave needs several cycles for a job, and a slave that is not in data exchange never answers.
//! A caller that wants to give up counts cycles or time from [`Client::start`] on. Giving up means
//! to drop the client, to see to it that data exchange starts again, and to take a new client: it
//! learns the handshake from the first telegram that it receives, as this one did. Another job
//! before that could be taken for the one that was given up.
//!
//! Source: KEB COMBIVERT F5 PROFIBUS-DP operator, 7.5.

use super::parameter_channel::LENGTH;
use super::{Channel, Refusal, Service, Settings};
use crate::field::Direction;

/// Does jobs of the parameter channel, one after the other.
///
/// ```
/// use buslens::profibus::Settings;
/// use buslens::profibus::client::{Client, Job, Outcome};
///
/// let mut client = Client::new(&Settings::default());
/// client.start(Job::Read { index: 0x2200, subindex: 0 }).expect("nothing else to do");
/// // What the slave shows before any job tells its handshake.
/// assert_eq!(client.receive(&[0; 8]), Outcome::Waiting);
/// assert_eq!(client.request(), [0x41, 0x00, 0x22, 0x00, 0, 0, 0, 0]);
/// assert_eq!(client.receive(&[0x71, 0x00, 0x22, 0x00, 0, 0, 0, 0x46]), Outcome::Done(Some(70)));
/// ```
#[derive(Clone, Debug)]
pub struct Client {
    settings: Settings,
    /// The handshake that the slave shows, once something was received.
    shown: Option<u8>,
    stage: Stage,
}

#[derive(Clone, Debug)]
enum Stage {
    Idle,
    /// The job waits for the slave's handshake.
    Waiting(Job),
    /// What is sent until the slave confirms it.
    Asked(Channel),
    /// The last request: it stays until there is another one.
    Finished(Channel),
}

/// What a slave is to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Job {
    Read {
        index: u16,
        subindex: u8,
    },
    /// `length` is 1 to 4 bytes (others are taken for the nearest); a KEB F5 takes every parameter
    /// with 4, too. Of a longer value the low bytes count.
    Write {
        index: u16,
        subindex: u8,
        length: usize,
        value: u32,
    },
}

/// What has become of the job with the telegram just received.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// There is no job.
    Idle,
    /// Send the request again.
    Waiting,
    /// With the value that was read, or that the slave says it wrote; `None` if it says none.
    Done(Option<u32>),
    Failed(Refusal),
}

/// A job is not finished yet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Busy;

impl Client {
    /// Of the settings only [`swap_channel`](Settings::swap_channel) counts.
    pub fn new(settings: &Settings) -> Self {
        Self { settings: settings.clone(), shown: None, stage: Stage::Idle }
    }

    /// Begins a job, unless one is waiting for its confirmation.
    pub fn start(&mut self, job: Job) -> Result<(), Busy> {
        match self.stage {
            Stage::Waiting(_) | Stage::Asked(_) => return Err(Busy),
            Stage::Idle | Stage::Finished(_) => {}
        }
        self.stage = match self.shown {
            Some(shown) => Stage::Asked(self.asking(job, shown)),
            None => Stage::Waiting(job),
        };
        Ok(())
    }

    /// What to send now. Before the slave's handshake is known, it asks for nothing.
    pub fn request(&self) -> [u8; LENGTH] {
        match &self.stage {
            Stage::Idle | Stage::Waiting(_) => [0; LENGTH],
            Stage::Asked(request) | Stage::Finished(request) => request.bytes(),
        }
    }

    /// Takes what the slave sent: its input data, of which the first 8 bytes count. Fewer bytes are
    /// no confirmation and change nothing.
    pub fn receive(&mut self, bytes: &[u8]) -> Outcome {
        let waiting = match &self.stage {
            Stage::Idle | Stage::Finished(_) => Outcome::Idle,
            Stage::Waiting(_) | Stage::Asked(_) => Outcome::Waiting,
        };
        if bytes.len() < LENGTH {
            return waiting;
        }
        let confirmation = Channel::read(bytes, Direction::Response, &self.settings);
        self.shown = Some(confirmation.handshake());
        match &self.stage {
            Stage::Waiting(job) => {
                self.stage = Stage::Asked(self.asking(*job, confirmation.handshake()));
                waiting
            }
            Stage::Asked(request) if request.handshake() == confirmation.handshake() => {
                let answer = confirmation.answering(request);
                self.stage = Stage::Finished(request.clone());
                match answer.refusal() {
                    Some(refusal) => Outcome::Failed(refusal),
                    None => Outcome::Done(answer.value()),
                }
            }
            Stage::Idle | Stage::Asked(_) | Stage::Finished(_) => waiting,
        }
    }

    /// The request for `job` to a slave that shows the handshake `shown`.
    fn asking(&self, job: Job, shown: u8) -> Channel {
        let mut request = Channel::new(Direction::Request, &self.settings);
        let (service, length) = match job {
            Job::Read { index, subindex } => {
                (request.index, request.subindex) = (index, subindex);
                (Service::Read, 1)
            }
            Job::Write { index, subindex, length, value } => {
                (request.index, request.subindex, request.value) = (index, subindex, value);
                (Service::Write, length.clamp(1, 4))
            }
        };
        request.ask(service, length, 1 - shown);
        request
    }
}

//! Requests that were sent and whose replies have not all been passed on.

use std::collections::VecDeque;

use kapvik_firmware::link::{Reply, Request};

/// Requests in the order in which they were sent.
#[derive(Debug, Default)]
pub(super) struct UnderWay {
    requests: VecDeque<Sent>,
    /// The last gap that was noticed, until something is answered.
    gap: Option<u16>,
}

#[derive(Debug)]
struct Sent {
    sequence: u16,
    request: Request,
    reply: Option<Reply>,
}

impl UnderWay {
    /// How many there are.
    pub fn len(&self) -> usize {
        self.requests.len()
    }

    /// Adds a request that is being sent.
    pub fn push(&mut self, sequence: u16, request: Request) {
        self.requests.push_back(Sent { sequence, request, reply: None });
    }

    /// The request that was added last.
    pub fn newest(&self) -> impl Iterator<Item = (u16, &Request)> {
        self.requests.back().into_iter().map(|sent| (sent.sequence, &sent.request))
    }

    /// The requests without a reply.
    pub fn unanswered(&self) -> impl Iterator<Item = (u16, &Request)> {
        self.requests.iter().filter(|sent| sent.reply.is_none()).map(|sent| (sent.sequence, &sent.request))
    }

    /// The requests from that number on.
    pub fn from(&self, sequence: u16) -> impl Iterator<Item = (u16, &Request)> {
        let later = self.requests.iter().skip_while(move |sent| sent.sequence != sequence);
        later.map(|sent| (sent.sequence, &sent.request))
    }

    /// Whether that number is under way and without a reply.
    pub fn holds(&self, sequence: u16) -> bool {
        self.requests.iter().any(|sent| sent.sequence == sequence && sent.reply.is_none())
    }

    /// Notes a reply.
    pub fn answer(&mut self, sequence: u16, reply: Reply) {
        self.gap = None;
        let sent = self.requests.iter_mut().find(|sent| sent.sequence == sequence);
        sent.into_iter().for_each(|sent| sent.reply = Some(reply.clone()));
    }

    /// The reply to the oldest request, if it has one; the request is then no longer under way.
    pub fn next_answered(&mut self) -> Option<Reply> {
        self.requests.front()?.reply.as_ref()?;
        self.requests.pop_front()?.reply
    }

    /// Whether the gap at that number has not been noticed yet.
    pub fn is_first_notice_of(&mut self, gap: u16) -> bool {
        self.gap.replace(gap) != Some(gap)
    }
}

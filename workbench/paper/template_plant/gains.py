"""What `workbench gains` searches for $name: a feedback that holds the mass at rest, whatever its damping is."""

from workbench.paper.plants.gains import feedback_search

from .plant import plant

search = feedback_search("$name", plant, rate="1.5", radius={"x": "0.2", "v": "0.5"})

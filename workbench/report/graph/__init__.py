"""Which line of a paper rests on which, as a picture and in words."""

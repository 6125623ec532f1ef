// What generators of clients leave out: retries, idempotency, jobs and their events. Give `Patient` to the client of the
// generator: new CounterweightClient(new HttpClient(new Patient(key)) { BaseAddress = ... }). C# 7, .NET and Mono.
using System;
using System.IO;
using System.Net.Http;
using System.Runtime.Serialization;
using System.Runtime.Serialization.Json;
using System.Text;
using System.Threading;
using System.Threading.Tasks;

/// <summary>Sends again what was cut off or refused for the moment; every POST has a key, so that it counts once.</summary>
public sealed class Patient : DelegatingHandler
{
    private readonly string key;
    private readonly TimeSpan patience;

    public Patient(string key = null, int patienceSeconds = 60) : base(new HttpClientHandler())
    {
        this.key = key;
        patience = TimeSpan.FromSeconds(patienceSeconds);
    }

    protected override async Task<HttpResponseMessage> SendAsync(HttpRequestMessage request, CancellationToken cancel)
    {
        if (key != null) request.Headers.TryAddWithoutValidation("Authorization", "Bearer " + key);
        if (request.Method == HttpMethod.Post && !request.Headers.Contains("Idempotency-Key"))
            request.Headers.Add("Idempotency-Key", Guid.NewGuid().ToString());
        var until = DateTime.UtcNow + patience;
        for (var wait = TimeSpan.FromMilliseconds(250); ; wait += wait)
        {
            HttpResponseMessage response = null;
            try { response = await base.SendAsync(request, cancel); }
            catch (HttpRequestException) when (DateTime.UtcNow + wait < until) { }
            if (response != null)
            {
                var asked = response.Headers.RetryAfter?.Delta;
                var busy = (int)response.StatusCode == 429 || (int)response.StatusCode == 503;
                if (!busy || asked == null || DateTime.UtcNow + asked > until) return response;
                wait = asked.Value;
                response.Dispose();
            }
            await Task.Delay(wait, cancel);
        }
    }
}

[DataContract]
public sealed class Links
{
    [DataMember(Name = "self")] public string Self;
    [DataMember(Name = "results")] public string Results;
}

[DataContract]
public sealed class Job
{
    [DataMember(Name = "id")] public string Id;
    [DataMember(Name = "state")] public string State;
    [DataMember(Name = "links")] public Links Links;

    public bool Active => State == "queued" || State == "running";

    public static Job Of(string json)
    {
        using (var stream = new MemoryStream(Encoding.UTF8.GetBytes(json)))
            return (Job)new DataContractJsonSerializer(typeof(Job)).ReadObject(stream);
    }
}

public static class Jobs
{
    /// <summary>Have a route answered later.</summary>
    public static async Task<Job> Later(this HttpClient client, string path, string json)
    {
        var request = new HttpRequestMessage(HttpMethod.Post, path);
        request.Content = new StringContent(json, Encoding.UTF8, "application/json");
        request.Headers.Add("Prefer", "respond-async");
        var response = await client.SendAsync(request);
        return Job.Of(await response.EnsureSuccessStatusCode().Content.ReadAsStringAsync());
    }

    /// <summary>Tell the states of a job up to its end; a stream that is cut goes on after the last event.</summary>
    public static async Task<Job> Finished(this HttpClient client, Job job, Action<Job> tell = null)
    {
        for (string last = null; job.Active;)
        {
            var request = new HttpRequestMessage(HttpMethod.Get, job.Links.Self + "/events");
            if (last != null) request.Headers.Add("Last-Event-ID", last);
            using (var response = await client.SendAsync(request, HttpCompletionOption.ResponseHeadersRead))
            using (var reader = new StreamReader(await response.EnsureSuccessStatusCode().Content.ReadAsStreamAsync()))
            {
                try
                {
                    for (string line; (line = await reader.ReadLineAsync()) != null;)
                    {
                        if (line.StartsWith("id:")) last = line.Substring(3).Trim();
                        if (!line.StartsWith("data:")) continue;
                        job = Job.Of(line.Substring(5));
                        tell?.Invoke(job);
                    }
                }
                catch (IOException) { await Task.Delay(500); }
            }
        }
        return job;
    }

    /// <summary>The answer of a job, once it is there, as JSON.</summary>
    public static async Task<string> Result(this HttpClient client, Job job)
    {
        job = await client.Finished(job);
        if (job.State != "done") throw new InvalidOperationException("job " + job.Id + " is " + job.State);
        return await client.GetStringAsync(job.Links.Results);
    }
}
